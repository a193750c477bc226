#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "energy_scale.h"

namespace block_world
{
/// The energies of one instant, J.
struct Energies
{
  double potential = 0.0;  ///< of gravity and of all springs
  double rotational = 0.0;
  double translational = 0.0;

  double total() const
  {
    return potential + rotational + translational;
  }
};

/// Potential, rotational and translational energy as bars laid end to end, the total marked where they end. A negative
/// potential goes to the left from 0, on a line of its own, and the others start where it ends.
class EnergyBars : public QWidget
{
public:
  explicit EnergyBars(QWidget* parent = nullptr);

  void show(const Energies& energies);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

  /// Where what is drawn lies, in pixels of Qt.
  struct Geometry
  {
    QRectF potential, rotational, translational;
    double zero = 0.0, total = 0.0;  ///< x
    QRectF area;                     ///< of the bars
  };
  Geometry geometryOfBars() const;
  const EnergyScale& scale() const;

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  double lineHeight() const;
  double xOf(double value, const QRectF& area) const;
  void paintBars(QPainter& painter) const;
  void paintAxis(QPainter& painter) const;
  void paintLegend(QPainter& painter) const;

  Energies energies_;
  EnergyScale scale_;
  QElapsedTimer since_;
};

}  // namespace block_world
