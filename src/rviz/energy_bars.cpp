#include "energy_bars.h"

#include <QPainter>

#include <algorithm>
#include <initializer_list>

#include "energy_colors.h"

namespace block_world
{
namespace
{
/// In lines of text: legend above, bars, then the numbers of the axis.
constexpr double LEGEND = 2.2, BARS = 1.8, AXIS = 1.4;

QString number(double value)
{
  return QString::number(value, 'g', 4);
}

}  // namespace

EnergyBars::EnergyBars(QWidget* parent) : QWidget(parent)
{
  setObjectName("energy_bars");
  setAccessibleName("Energies as bars");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  since_.start();
}

void EnergyBars::show(const Energies& energies)
{
  energies_ = energies;
  // Where the last bar ends is the total; with a negative potential nothing reaches farther to the right than 0 or
  // that.
  scale_.adapt(std::min(energies.potential, 0.0), std::max(energies.total(), 0.0),
               static_cast<double>(since_.restart()) * 1e-3);
  update();
}

QSize EnergyBars::sizeHint() const
{
  return QSize(static_cast<int>(20 * lineHeight()), static_cast<int>((LEGEND + BARS + AXIS) * lineHeight()));
}

QSize EnergyBars::minimumSizeHint() const
{
  return QSize(static_cast<int>(10 * lineHeight()), sizeHint().height());
}

const EnergyScale& EnergyBars::scale() const
{
  return scale_;
}

double EnergyBars::lineHeight() const
{
  return fontMetrics().lineSpacing();
}

double EnergyBars::xOf(double value, const QRectF& area) const
{
  const double span = scale_.high() - scale_.low();
  return area.left() + (span > 0.0 ? (value - scale_.low()) / span * area.width() : 0.0);
}

EnergyBars::Geometry EnergyBars::geometryOfBars() const
{
  Geometry geometry;
  const double margin = lineHeight();
  geometry.area = QRectF(margin, LEGEND * lineHeight(), width() - 2 * margin, BARS * lineHeight());
  const QRectF& area = geometry.area;
  geometry.zero = xOf(0.0, area);
  geometry.total = xOf(energies_.total(), area);

  const bool negative = energies_.potential < 0.0;
  const double height = negative ? area.height() / 2 : area.height();
  const auto bar = [&](double from, double to, double top) {
    return QRectF(QPointF(xOf(from, area), top), QPointF(xOf(to, area), top + height));
  };
  double end = energies_.potential;
  geometry.potential = bar(std::min(end, 0.0), std::max(end, 0.0), area.top());
  const double top = negative ? area.top() + height : area.top();
  geometry.rotational = bar(end, end + energies_.rotational, top);
  end += energies_.rotational;
  geometry.translational = bar(end, end + energies_.translational, top);
  return geometry;
}

void EnergyBars::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  paintLegend(painter);
  paintAxis(painter);
  paintBars(painter);
}

void EnergyBars::paintBars(QPainter& painter) const
{
  const Geometry geometry = geometryOfBars();
  painter.fillRect(geometry.potential, energy_colors::POTENTIAL);
  painter.fillRect(geometry.rotational, energy_colors::ROTATIONAL);
  painter.fillRect(geometry.translational, energy_colors::TRANSLATIONAL);

  // The zero line, and a caret that points at the total from above.
  painter.setPen(QPen(palette().color(QPalette::WindowText), 1));
  painter.drawLine(QPointF(geometry.zero, geometry.area.top() - 2), QPointF(geometry.zero, geometry.area.bottom() + 2));
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(energy_colors::TOTAL, 1.5));
  painter.setBrush(energy_colors::TOTAL);
  const double size = 0.35 * lineHeight();
  const QPointF tip(geometry.total, geometry.area.top());
  painter.drawPolygon(QPolygonF({ tip, tip + QPointF(-size, -size), tip + QPointF(size, -size) }));
  painter.drawLine(tip, QPointF(geometry.total, geometry.area.bottom()));
}

void EnergyBars::paintAxis(QPainter& painter) const
{
  const QRectF area = geometryOfBars().area;
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawRect(area);
  const double widest = fontMetrics().horizontalAdvance("-0.0000 J");
  for (const double tick : scale_.ticks(std::max(1, static_cast<int>(area.width() / widest))))
  {
    const double x = xOf(tick, area);
    painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 0.25 * lineHeight()));
    const QRectF text(x - widest / 2, area.bottom() + 0.3 * lineHeight(), widest, lineHeight());
    painter.drawText(text, Qt::AlignCenter, number(tick) + " J");
  }
}

/// Name over value, four columns wide.
void EnergyBars::paintLegend(QPainter& painter) const
{
  struct Entry
  {
    const char* name;
    double value;
    QColor color;
  };
  const std::initializer_list<Entry> entries = {
    { "potential", energies_.potential, energy_colors::POTENTIAL },
    { "rotational", energies_.rotational, energy_colors::ROTATIONAL },
    { "translational", energies_.translational, energy_colors::TRANSLATIONAL },
    { "total", energies_.total(), energy_colors::TOTAL },
  };
  // Each gets the room that its name and number need, and a fair share of what is left.
  const double square = 0.6 * lineHeight(), gap = 0.4 * lineHeight();
  const auto needs = [this](const Entry& entry) {
    return std::max(fontMetrics().horizontalAdvance(entry.name), fontMetrics().horizontalAdvance("-0.0000 J")) + 1;
  };
  double share = width();
  for (const Entry& entry : entries)
    share -= square + gap + needs(entry);
  share /= static_cast<double>(entries.size());
  double x = 0.0;
  for (const Entry& entry : entries)
  {
    painter.fillRect(QRectF(x + 1, 0.2 * lineHeight(), square, square), entry.color);
    painter.setPen(palette().color(QPalette::WindowText));
    const double left = x + square + gap / 2, base = fontMetrics().ascent();
    const int room = needs(entry) + std::min(0, static_cast<int>(share));
    painter.drawText(QPointF(left, base), fontMetrics().elidedText(entry.name, Qt::ElideRight, room));
    painter.drawText(QPointF(left, base + 0.9 * lineHeight()), number(entry.value) + " J");
    x += square + gap + room + std::max(share, 0.0);
  }
}

}  // namespace block_world
