#pragma once

#include <QColor>

namespace block_world
{
/// Of bars and lines alike. Told apart by brightness too, for those who see colours otherwise.
namespace energy_colors
{
const QColor POTENTIAL(58, 82, 139);
const QColor ROTATIONAL(236, 190, 70);
const QColor TRANSLATIONAL(66, 160, 125);
const QColor TOTAL(190, 30, 45);
}  // namespace energy_colors
}  // namespace block_world
