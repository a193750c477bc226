#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include <deque>

#include "energy_bars.h"
#include "energy_scale.h"

namespace block_world
{
/// The energies of the last 20 s of simulated time, as lines.
class EnergyStrip : public QWidget
{
public:
  static constexpr double WINDOW = 20.0;  ///< s

  explicit EnergyStrip(QWidget* parent = nullptr);

  /// Time in s. Starts afresh where time has gone back.
  void add(double time, const Energies& energies);
  void clear();
  /// Adapts the scale to what there is to see, and draws it.
  void refresh();

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

  struct Sample
  {
    double time;
    Energies energies;
  };
  const std::deque<Sample>& samples() const;

  /// From time and energy to pixels of Qt.
  struct Map
  {
    QRectF area;
    double newest = 0.0;  ///< s
    double low = 0.0, high = 0.0;

    QPointF operator()(double time, double energy) const;
  };
  Map map() const;

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  void paintAxes(QPainter& painter, const Map& map) const;
  template <class Value>
  void paintLine(QPainter& painter, const Map& map, const QPen& pen, Value value) const;

  std::deque<Sample> samples_;
  EnergyScale scale_;
  QElapsedTimer since_;
};

}  // namespace block_world
