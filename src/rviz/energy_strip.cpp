#include "energy_strip.h"

#include <QPainter>

#include <algorithm>

#include "energy_colors.h"

namespace block_world
{
namespace
{
// More cannot be told apart on a screen.
constexpr double MOST_SAMPLES = 1000.0;
}  // namespace

EnergyStrip::EnergyStrip(QWidget* parent) : QWidget(parent)
{
  setObjectName("energy_strip");
  setAccessibleName("Energies of the last 20 s");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  since_.start();
}

void EnergyStrip::add(double time, const Energies& energies)
{
  if (!samples_.empty() && time < samples_.back().time)
    samples_.clear();
  // What follows too closely takes the place of the last one, so that the newest is always there.
  const std::size_t size = samples_.size();
  if (size >= 2 && time < samples_[size - 2].time + WINDOW / MOST_SAMPLES)
    samples_.back() = { time, energies };
  else
    samples_.push_back({ time, energies });
  while (samples_.front().time < time - WINDOW)
    samples_.pop_front();
}

void EnergyStrip::clear()
{
  samples_.clear();
  update();
}

void EnergyStrip::refresh()
{
  double low = 0.0, high = 0.0;
  for (const Sample& sample : samples_)
  {
    const Energies& e = sample.energies;
    low = std::min({ low, e.potential, e.total() });
    high = std::max({ high, e.potential, e.rotational, e.translational, e.total() });
  }
  scale_.adapt(low, high, static_cast<double>(since_.restart()) * 1e-3);
  update();
}

QSize EnergyStrip::sizeHint() const
{
  const int line = fontMetrics().lineSpacing();
  return QSize(20 * line, 8 * line);
}

QSize EnergyStrip::minimumSizeHint() const
{
  const int line = fontMetrics().lineSpacing();
  return QSize(10 * line, 4 * line);
}

const std::deque<EnergyStrip::Sample>& EnergyStrip::samples() const
{
  return samples_;
}

QPointF EnergyStrip::Map::operator()(double time, double energy) const
{
  const double share = high > low ? (energy - low) / (high - low) : 0.0;
  return QPointF(area.right() - (newest - time) / WINDOW * area.width(), area.bottom() - share * area.height());
}

EnergyStrip::Map EnergyStrip::map() const
{
  const double line = fontMetrics().lineSpacing();
  const double left = fontMetrics().horizontalAdvance("-0.0000 ");
  return { QRectF(left, 0.5 * line, width() - left - 0.5 * line, height() - 2 * line),
           samples_.empty() ? 0.0 : samples_.back().time, scale_.low(), scale_.high() };
}

void EnergyStrip::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  const Map map = this->map();
  painter.fillRect(map.area, palette().color(QPalette::Base));
  paintAxes(painter, map);

  painter.setRenderHint(QPainter::Antialiasing);
  painter.setClipRect(map.area.adjusted(-1, -1, 1, 1));
  paintLine(painter, map, QPen(energy_colors::POTENTIAL, 1.2), [](const Energies& e) { return e.potential; });
  paintLine(painter, map, QPen(energy_colors::ROTATIONAL, 1.2), [](const Energies& e) { return e.rotational; });
  paintLine(painter, map, QPen(energy_colors::TRANSLATIONAL, 1.2), [](const Energies& e) { return e.translational; });
  paintLine(painter, map, QPen(energy_colors::TOTAL, 2.0), [](const Energies& e) { return e.total(); });
}

void EnergyStrip::paintAxes(QPainter& painter, const Map& map) const
{
  const QRectF& area = map.area;
  const double line = fontMetrics().lineSpacing();
  const QColor strong = palette().color(QPalette::WindowText);
  QColor faint = strong;
  faint.setAlphaF(0.25);
  for (const double tick : scale_.ticks(std::max(1, static_cast<int>(area.height() / (1.5 * line)))))
  {
    const double y = map(map.newest, tick).y();
    painter.setPen(faint);
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
    painter.setPen(strong);
    painter.drawText(QRectF(0, y - line / 2, area.left() - 4, line), Qt::AlignRight | Qt::AlignVCenter,
                     QString::number(tick, 'g', 4));
  }
  const double wide = 6 * line;
  for (double ago = 0.0; ago <= WINDOW; ago += 5.0)
  {
    const double x = map(map.newest - ago, 0.0).x();
    painter.setPen(faint);
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    painter.setPen(strong);
    if (ago == 0.0)
      painter.drawText(QRectF(x - wide, area.bottom() + 2, wide, line), Qt::AlignRight,
                       QString("%1 s").arg(map.newest, 0, 'f', 1));
    else
      painter.drawText(QRectF(x - wide / 2, area.bottom() + 2, wide, line), Qt::AlignHCenter,
                       QString("-%1 s").arg(ago));
  }
}

template <class Value>
void EnergyStrip::paintLine(QPainter& painter, const Map& map, const QPen& pen, Value value) const
{
  QPolygonF line;
  for (const Sample& sample : samples_)
    line << map(sample.time, value(sample.energies));
  painter.setPen(pen);
  painter.drawPolyline(line);
}

}  // namespace block_world
