#pragma once

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QSlider>

#include <functional>
#include <string>

namespace block_world
{
/// A parameter of the world with its slider and number field.
class ValueRow
{
public:
  struct Spec
  {
    std::string name;  ///< of the parameter
    const char* label;
    const char* unit;
    double least, most;  ///< of the number field
    double slider_most;  ///< a slider has to end somewhere
    int decimals;
  };

  /// Adds itself as a row; on_change gets what the user has chosen.
  ValueRow(const Spec& spec, QGridLayout* layout, const std::function<void(double)>& on_change);

  const std::string& name() const;
  /// Shows a value that the world tells, unless the user is about to choose one.
  void show(double value);

private:
  int sliderPosition(double value) const;

  Spec spec_;
  QSlider* slider_;
  QDoubleSpinBox* field_;
};

}  // namespace block_world
