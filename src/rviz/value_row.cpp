#include "value_row.h"

#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace block_world
{
namespace
{
constexpr int SLIDER_STEPS = 200;
}

ValueRow::ValueRow(const Spec& spec, QGridLayout* layout, const std::function<void(double)>& on_change)
  : spec_(spec), slider_(new QSlider(Qt::Horizontal)), field_(new QDoubleSpinBox)
{
  const bool whole = spec.decimals == 0;
  slider_->setObjectName(QString::fromStdString(spec.name) + "_slider");
  slider_->setRange(0, whole ? static_cast<int>(spec.slider_most - spec.least) : SLIDER_STEPS);
  slider_->setPageStep(whole ? 1 : SLIDER_STEPS / 10);
  slider_->setMinimumWidth(slider_->fontMetrics().horizontalAdvance("000000"));
  field_->setObjectName(QString::fromStdString(spec.name) + "_field");
  field_->setDecimals(spec.decimals);
  field_->setRange(spec.least, spec.most);
  field_->setSingleStep(whole ? 1.0 : (spec.slider_most - spec.least) / 20);
  field_->setSuffix(*spec.unit ? QString(" ") + spec.unit : QString());
  field_->setMaximumWidth(field_->fontMetrics().horizontalAdvance("0000.000 N s/m  ") + field_->sizeHint().height());
  field_->setKeyboardTracking(false);  // the number counts when it is complete

  QLabel* label = new QLabel(spec.label);
  label->setBuddy(field_);
  const int row = layout->rowCount();
  layout->addWidget(label, row, 0);
  layout->addWidget(slider_, row, 1);
  layout->addWidget(field_, row, 2);
  layout->setColumnStretch(1, 1);

  QObject::connect(slider_, &QSlider::valueChanged, field_, [this](int position) {
    field_->setValue(spec_.least + (spec_.slider_most - spec_.least) * position / slider_->maximum());
  });
  QObject::connect(field_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), slider_,
                   [this, on_change](double value) {
                     const QSignalBlocker blocker(slider_);
                     slider_->setValue(sliderPosition(value));
                     on_change(value);
                   });
}

const std::string& ValueRow::name() const
{
  return spec_.name;
}

int ValueRow::sliderPosition(double value) const
{
  const double share = (value - spec_.least) / (spec_.slider_most - spec_.least);
  return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * slider_->maximum()));
}

void ValueRow::show(double value)
{
  const bool typing = field_->hasFocus() && field_->findChild<QLineEdit*>()->isModified();
  if (slider_->isSliderDown() || typing)
    return;
  const QSignalBlocker block_slider(slider_), block_field(field_);
  slider_->setValue(sliderPosition(value));
  field_->setValue(value);
}

}  // namespace block_world
