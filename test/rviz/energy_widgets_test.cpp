#include "energy_bars.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QImage>
#include <QPainter>

#include <cmath>

#include "energy_colors.h"
#include "energy_scale.h"
#include "energy_strip.h"

namespace block_world
{
namespace
{
constexpr double FRAME = 0.04;  // s
// Qt's rectangles are exact to rounding.
constexpr double NO_PIXEL = 1e-9;

Energies energies(double potential, double rotational, double translational)
{
  Energies result;
  result.potential = potential;
  result.rotational = rotational;
  result.translational = translational;
  return result;
}

QImage picture(QWidget& widget, int pixel_ratio)
{
  QImage image(widget.size() * pixel_ratio, QImage::Format_RGB32);
  image.setDevicePixelRatio(pixel_ratio);
  image.fill(Qt::black);
  widget.render(&image);
  return image;
}

QColor colorAt(const QImage& image, const QPointF& point)
{
  const double ratio = image.devicePixelRatio();
  return image.pixelColor(static_cast<int>(point.x() * ratio), static_cast<int>(point.y() * ratio));
}

}  // namespace

TEST(EnergyScale, whatThereIsToShowIsAlwaysIn)
{
  EnergyScale scale;
  for (int i = 0; i < 2000; ++i)
  {
    const double high = std::exp(10 * std::sin(0.013 * i)), low = -std::exp(10 * std::sin(0.017 * i));
    scale.adapt(low, high, FRAME);
    ASSERT_LE(scale.low(), low);
    ASSERT_GE(scale.high(), high);
  }
}

TEST(EnergyScale, staysWhileTheRangeIsWellUsed)
{
  EnergyScale scale;
  scale.adapt(0.0, 10.0, FRAME);
  const double high = scale.high();
  for (int i = 0; i < 1000; ++i)
    scale.adapt(0.0, 7.5 + 2.5 * std::sin(i), FRAME);
  EXPECT_EQ(scale.high(), high);
}

TEST(EnergyScale, givesUpRoomLittleByLittle)
{
  EnergyScale scale;
  scale.adapt(0.0, 100.0, FRAME);
  double before = scale.high();
  for (int i = 0; i < 500; ++i)
  {
    scale.adapt(0.0, 1.0, FRAME);
    ASSERT_LE(scale.high(), before);
    ASSERT_GT(scale.high(), 0.9 * before) << "a jump that the eye would see";
    before = scale.high();
  }
  EXPECT_LT(scale.high(), 1.5);
}

TEST(EnergyScale, ticksAreRound)
{
  EnergyScale scale;
  scale.adapt(-1.0, 3.0, FRAME);
  for (const int most : { 1, 2, 3, 5, 8, 20 })
  {
    const std::vector<double> ticks = scale.ticks(most);
    ASSERT_FALSE(ticks.empty());
    EXPECT_LE(ticks.size(), static_cast<std::size_t>(most) + 1);
    for (const double tick : ticks)
    {
      EXPECT_GE(tick, scale.low());
      EXPECT_LE(tick, scale.high());
      EXPECT_NEAR(std::remainder(tick, 0.05), 0.0, 1e-12);
    }
  }
  EXPECT_EQ(EnergyScale().ticks(5), std::vector<double>{ 0.0 });
}

TEST(EnergyBars, lieEndToEnd)
{
  EnergyBars bars;
  bars.resize(400, 100);
  bars.show(energies(1.0, 0.5, 2.0));
  const EnergyBars::Geometry g = bars.geometryOfBars();
  const double per_joule = g.area.width() / (bars.scale().high() - bars.scale().low());
  EXPECT_NEAR(g.zero, g.area.left(), NO_PIXEL);
  EXPECT_NEAR(g.potential.left(), g.zero, NO_PIXEL);
  EXPECT_NEAR(g.potential.width(), 1.0 * per_joule, NO_PIXEL);
  EXPECT_NEAR(g.rotational.left(), g.potential.right(), NO_PIXEL);
  EXPECT_NEAR(g.rotational.width(), 0.5 * per_joule, NO_PIXEL);
  EXPECT_NEAR(g.translational.left(), g.rotational.right(), NO_PIXEL);
  EXPECT_NEAR(g.translational.width(), 2.0 * per_joule, NO_PIXEL);
  EXPECT_NEAR(g.total, g.translational.right(), NO_PIXEL);
  EXPECT_LE(g.total, g.area.right());
}

TEST(EnergyBars, negativePotentialGoesLeftAndTheOthersStartWhereItEnds)
{
  EnergyBars bars;
  bars.resize(400, 100);
  bars.show(energies(-2.0, 0.5, 1.0));
  const EnergyBars::Geometry g = bars.geometryOfBars();
  const double per_joule = g.area.width() / (bars.scale().high() - bars.scale().low());
  EXPECT_NEAR(g.potential.right(), g.zero, NO_PIXEL);
  EXPECT_NEAR(g.potential.width(), 2.0 * per_joule, NO_PIXEL);
  EXPECT_GE(g.potential.left(), g.area.left());
  EXPECT_NEAR(g.rotational.left(), g.potential.left(), NO_PIXEL);
  EXPECT_NEAR(g.total, g.zero - 0.5 * per_joule, NO_PIXEL);
  EXPECT_NEAR(g.translational.right(), g.total, NO_PIXEL);
  EXPECT_LE(g.potential.bottom(), g.rotational.top() + NO_PIXEL) << "on a line of its own";
}

TEST(EnergyBars, arePaintedWhereTheyAre)
{
  for (const int pixel_ratio : { 1, 2, 3 })
    for (const double potential : { 3.0, -3.0 })
    {
      EnergyBars bars;
      bars.resize(500, 100);
      bars.show(energies(potential, 2.0, 4.0));
      const QImage image = picture(bars, pixel_ratio);
      const EnergyBars::Geometry g = bars.geometryOfBars();
      // Off the middle, where the lines of zero or total may pass.
      const auto inside = [](const QRectF& bar) {
        return bar.topLeft() + QPointF(0.3 * bar.width(), 0.5 * bar.height());
      };
      EXPECT_EQ(colorAt(image, inside(g.potential)), energy_colors::POTENTIAL);
      EXPECT_EQ(colorAt(image, inside(g.rotational)), energy_colors::ROTATIONAL);
      EXPECT_EQ(colorAt(image, inside(g.translational)), energy_colors::TRANSLATIONAL);
      EXPECT_EQ(colorAt(image, QPointF(g.total, g.area.top() - 3)), energy_colors::TOTAL) << "the caret";
    }
}

TEST(EnergyBars, fitIntoEverySize)
{
  EnergyBars bars;
  for (const int width : { 1, 40, 2000 })
  {
    bars.resize(width, bars.sizeHint().height());
    for (const double potential : { 0.0, 1e-300, -1e12, 1e300 })
    {
      bars.show(energies(potential, 0.0, 0.0));
      picture(bars, 1);
    }
  }
}

TEST(EnergyStrip, showsTheLastTwentySeconds)
{
  EnergyStrip strip;
  strip.resize(600, 200);
  for (int i = 0; i <= 3000; ++i)
    strip.add(0.01 * i, energies(1.0 + 0.5 * std::sin(0.01 * i), 0.25, 0.75 - 0.5 * std::sin(0.01 * i)));
  strip.refresh();
  EXPECT_NEAR(strip.samples().front().time, 10.0, 0.1);
  EXPECT_EQ(strip.samples().back().time, 30.0);

  const EnergyStrip::Map map = strip.map();
  EXPECT_NEAR(map(30.0, 0.0).x(), map.area.right(), NO_PIXEL);
  EXPECT_NEAR(map(10.0, 0.0).x(), map.area.left(), NO_PIXEL);
  const double per_joule = map(30.0, 0.0).y() - map(30.0, 1.0).y();
  EXPECT_GT(per_joule, 0.0);
  for (const EnergyStrip::Sample& sample : strip.samples())
    EXPECT_NEAR(map(sample.time, sample.energies.total()).y(), map(30.0, 2.0).y(), 1e-9) << "the total is flat";
  EXPECT_GE(map(30.0, 2.0).y(), map.area.top());

  const QImage image = picture(strip, 2);
  EXPECT_EQ(colorAt(image, map(20.0, 2.0)), energy_colors::TOTAL);
}

TEST(EnergyStrip, keepsFewSamplesHoweverManyCome)
{
  EnergyStrip strip;
  for (int i = 0; i <= 400000; ++i)
    strip.add(1e-4 * i, energies(i, 0.0, 0.0));
  EXPECT_LE(strip.samples().size(), 1100u);
  EXPECT_GE(strip.samples().size(), 900u);
  EXPECT_EQ(strip.samples().back().energies.potential, 400000.0) << "the newest is always there";
}

TEST(EnergyStrip, startsAfreshWhereTimeGoesBack)
{
  EnergyStrip strip;
  strip.add(5.0, energies(1, 2, 3));
  strip.add(6.0, energies(1, 2, 3));
  strip.add(0.0, energies(1, 2, 3));
  EXPECT_EQ(strip.samples().size(), 1u);
}

}  // namespace block_world

int main(int argc, char** argv)
{
  qputenv("QT_QPA_PLATFORM", "offscreen");
  testing::InitGoogleTest(&argc, argv);
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
