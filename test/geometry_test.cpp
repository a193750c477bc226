#include "geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace block_world
{
namespace
{
const double pi = std::acos(-1.0);

std::vector<Vec2> rectangle(double width, double height)
{
  const double x = width / 2.0, y = height / 2.0;
  return { Vec2(-x, -y), Vec2(x, -y), Vec2(x, y), Vec2(-x, y) };
}

std::vector<Vec2> regular(int corners, double radius)
{
  std::vector<Vec2> vertices;
  for (int i = 0; i < corners; ++i)
    vertices.emplace_back(radius * std::cos(2.0 * pi * i / corners), radius * std::sin(2.0 * pi * i / corners));
  return vertices;
}

std::vector<Vec2> moved(std::vector<Vec2> vertices, const Vec2& shift)
{
  for (Vec2& p : vertices)
    p += shift;
  return vertices;
}

void expectNear(const Vec2& actual, const Vec2& expected, double error)
{
  EXPECT_NEAR(actual.x(), expected.x(), error);
  EXPECT_NEAR(actual.y(), expected.y(), error);
}

TEST(AreaMoments, Rectangle)
{
  const double w = 1.5, h = 0.7;
  const AreaMoments moments = areaMoments(moved(rectangle(w, h), Vec2(3.0, -2.0)));
  EXPECT_NEAR(moments.area, w * h, 1e-15);
  expectNear(moments.centroid, Vec2(3.0, -2.0), 1e-15);
  EXPECT_NEAR(moments.gyration, (w * w + h * h) / 12.0, 1e-15);
}

TEST(AreaMoments, Triangle)
{
  const std::vector<Vec2> corners{ Vec2(0.2, 0.1), Vec2(2.0, 0.5), Vec2(0.7, 1.9) };
  const AreaMoments moments = areaMoments(corners);
  EXPECT_NEAR(moments.area, cross(corners[1] - corners[0], corners[2] - corners[0]) / 2.0, 1e-15);
  expectNear(moments.centroid, (corners[0] + corners[1] + corners[2]) / 3.0, 1e-15);
  // The sum of the squared sides over 36.
  double sides = 0.0;
  for (int i = 0; i < 3; ++i)
    sides += (corners[(i + 1) % 3] - corners[i]).squaredNorm();
  EXPECT_NEAR(moments.gyration, sides / 36.0, 1e-15);
}

TEST(AreaMoments, RegularPolygon)
{
  for (const int n : { 3, 5, 6, 17 })
  {
    const double r = 1.3;
    const AreaMoments moments = areaMoments(regular(n, r));
    EXPECT_NEAR(moments.area, n * r * r * std::sin(2.0 * pi / n) / 2.0, 1e-14);
    EXPECT_NEAR(moments.gyration, r * r * (2.0 + std::cos(2.0 * pi / n)) / 6.0, 1e-14);
  }
}

TEST(AreaMoments, ClockwiseIsNegative)
{
  std::vector<Vec2> vertices = rectangle(2.0, 1.0);
  std::reverse(vertices.begin(), vertices.end());
  EXPECT_DOUBLE_EQ(areaMoments(vertices).area, -2.0);
}

TEST(AreaMoments, FarFromTheOrigin)
{
  const AreaMoments moments = areaMoments(moved(rectangle(1.0, 2.0), Vec2(1048576.0, -2097152.0)));
  EXPECT_DOUBLE_EQ(moments.area, 2.0);
  EXPECT_NEAR(moments.gyration, 5.0 / 12.0, 1e-14);
}

TEST(AreaMoments, TooFewVertices)
{
  EXPECT_EQ(areaMoments({ Vec2(0.0, 0.0), Vec2(1.0, 0.0) }).area, 0.0);
}

TEST(Polygon, FacesPointOutwards)
{
  const Polygon polygon = makePolygon(rectangle(3.0, 1.0));
  ASSERT_EQ(polygon.faces.size(), 4u);
  expectNear(polygon.faces[0].normal, Vec2(0.0, -1.0), 0.0);
  expectNear(polygon.faces[1].normal, Vec2(1.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(polygon.faces[0].offset, 0.5);
  EXPECT_DOUBLE_EQ(polygon.faces[1].offset, 1.5);
  EXPECT_DOUBLE_EQ(polygon.faces[0].length, 3.0);
  EXPECT_DOUBLE_EQ(polygon.radius, std::sqrt(2.5));
  EXPECT_NEAR(polygon.gyration, 10.0 / 12.0, 1e-15);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Face& face = polygon.faces[i];
    EXPECT_NEAR(face.normal.dot(polygon.vertices[i] + face.length * perp(face.normal)), face.offset, 1e-15);
  }
}

TEST(Frame, ThereAndBack)
{
  const Frame frame(Vec2(1.0, 2.0), pi / 6.0);
  expectNear(frame.toWorld(Vec2(2.0, 0.0)), Vec2(1.0 + std::sqrt(3.0), 3.0), 1e-15);
  expectNear(frame.toBody(frame.toWorld(Vec2(-0.3, 0.8))), Vec2(-0.3, 0.8), 1e-15);
}

TEST(Separation, BoxesSideBySide)
{
  const Polygon box = makePolygon(rectangle(1.0, 1.0));
  for (const double gap : { 0.5, 1e-9, 0.0, -1e-9, -0.25 })
    EXPECT_NEAR(separation(box, Frame(), box, Frame(Vec2(1.0 + gap, 0.3), 0.0)), gap, 1e-15);
}

TEST(Separation, TurnedSquareOverFace)
{
  const Polygon box = makePolygon(rectangle(1.0, 1.0));
  const double reach = std::sqrt(0.5);
  EXPECT_NEAR(separation(box, Frame(), box, Frame(Vec2(0.1, 0.5 + reach + 0.2), pi / 4.0)), 0.2, 1e-15);
}

TEST(Separation, DependsOnNeitherOrderNorFrame)
{
  const Polygon a = makePolygon(regular(5, 0.8)), b = makePolygon(rectangle(0.4, 1.7));
  const Vec2 position_a(0.2, 0.1), position_b(1.3, 0.4);
  const double expected = separation(a, Frame(position_a, 0.3), b, Frame(position_b, -0.4));
  EXPECT_DOUBLE_EQ(separation(b, Frame(position_b, -0.4), a, Frame(position_a, 0.3)), expected);

  const Frame turn(Vec2(5.0, -3.0), 1.1);
  const Frame moved_a(turn.toWorld(position_a), 0.3 + 1.1), moved_b(turn.toWorld(position_b), -0.4 + 1.1);
  EXPECT_NEAR(separation(a, moved_a, b, moved_b), expected, 1e-14);
}

TEST(Separation, CornersApartArePositive)
{
  const Polygon box = makePolygon(rectangle(1.0, 1.0));
  EXPECT_GT(separation(box, Frame(), box, Frame(Vec2(1.01, 1.01), 0.0)), 0.0);
  EXPECT_LT(separation(box, Frame(), box, Frame(Vec2(0.99, 0.99), 0.0)), 0.0);
}

TEST(Separation, HalfPlane)
{
  const Polygon floor = makeHalfPlane(Vec2(0.0, 1.0), -2.0), box = makePolygon(rectangle(2.0, 1.0));
  EXPECT_NEAR(separation(floor, Frame(), box, Frame(Vec2(7.0, 0.0), 0.0)), 1.5, 1e-15);
  EXPECT_NEAR(separation(box, Frame(Vec2(7.0, 0.0), pi / 2.0), floor, Frame()), 1.0, 1e-15);
  EXPECT_NEAR(separation(floor, Frame(), box, Frame(Vec2(7.0, -2.0), 0.0)), -0.5, 1e-15);
}

TEST(NearestPoint, OfARectangle)
{
  const Polygon box = makePolygon(rectangle(2.0, 1.0));
  expectNear(nearestPoint(box, Vec2(0.3, -0.2)), Vec2(0.3, -0.2), 0.0);
  expectNear(nearestPoint(box, Vec2(0.3, 4.0)), Vec2(0.3, 0.5), 1e-15);
  expectNear(nearestPoint(box, Vec2(-3.0, 0.1)), Vec2(-1.0, 0.1), 1e-15);
  expectNear(nearestPoint(box, Vec2(5.0, 6.0)), Vec2(1.0, 0.5), 1e-15);
}

TEST(NearestPoint, IsNoFartherThanAnyPointOfTheRim)
{
  const Polygon polygon = makePolygon(regular(5, 1.0));
  for (int i = 0; i < 40; ++i)
  {
    const Vec2 point(2.0 * std::cos(0.37 * i), 1.5 * std::sin(0.37 * i));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < polygon.faces.size(); ++f)
      for (int k = 0; k <= 1000; ++k)
      {
        const Face& face = polygon.faces[f];
        least = std::min(least, (polygon.vertices[f] + k / 1000.0 * face.length * perp(face.normal) - point).norm());
      }
    const double found = (nearestPoint(polygon, point) - point).norm();
    EXPECT_LE(found, least + 1e-15);
    EXPECT_NEAR(found, least, 1e-5);
  }
}

}  // namespace
}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
