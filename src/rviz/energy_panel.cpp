#include "energy_panel.h"

#include <pluginlib/class_list_macros.hpp>

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>
#include <QVBoxLayout>

#include "energy_bars.h"
#include "energy_strip.h"
#include "topics.h"

namespace block_world
{
namespace
{
constexpr int REFRESH_MS = 40;
constexpr double HUGE_VALUE = 1e6;

// The ends of the sliders are what makes sense for blocks of metres and kilograms; the fields take more.
const ValueRow::Spec VALUES[] = {
  { "gravity", "&Gravity", "m/s²", 0.0, HUGE_VALUE, 20.0, 3 },
  { "elasticity", "&Elasticity", "", 0.0, 1.0, 1.0, 3 },
  { "damping", "&Damping", "N s/m", 0.0, HUGE_VALUE, 2.0, 3 },
  { "thrust", "&Thrust", "N", 0.0, HUGE_VALUE, 10.0, 3 },
  { "mass", "&Mass of the first block", "kg", 0.001, HUGE_VALUE, 10.0, 3 },
  { "count", "&Number of blocks", "", 1.0, HUGE_VALUE, 6.0, 0 },
  { "real_time_factor", "Real-time &factor", "", 0.0, 1000.0, 4.0, 3 },
};

Energies energiesOf(const msg::Energy& message)
{
  return { message.gravity + message.spring, message.rotational, message.translational };
}

}  // namespace

EnergyPanel::EnergyPanel(QWidget* parent) : rviz::Panel(parent)
{
  new QVBoxLayout(this);
  addEnergies();
  controls_ = new QWidget;
  controls_->setLayout(new QVBoxLayout);
  controls_->layout()->setContentsMargins(0, 0, 0, 0);
  layout()->addWidget(controls_);
  addValues();
  addButtons();

  world_.on_energy = [this](const msg::Energy& message) { onEnergy(message); };
  world_.on_parameters = [this](const std::map<std::string, double>& parameters) {
    has_values_ = true;
    for (const std::unique_ptr<ValueRow>& row : values_)
      if (parameters.count(row->name()) > 0)
        row->show(parameters.at(row->name()));
  };
  world_.on_answer = [this](const QString& text) {
    answer_->setText(text);
    answer_->setToolTip(text);
  };
  connectWorld();
  connect(&refresh_timer_, &QTimer::timeout, this, [this] { refresh(); });
  refresh_timer_.start(REFRESH_MS);
}

void EnergyPanel::addEnergies()
{
  show_energy_ = new QCheckBox("&Show energy");
  show_energy_->setObjectName("show_energy");
  show_energy_->setChecked(true);
  status_ = new QLabel;
  status_->setObjectName("status");
  status_->setAlignment(Qt::AlignRight);
  QHBoxLayout* row = new QHBoxLayout;
  row->addWidget(show_energy_);
  row->addWidget(status_, 1);
  bars_ = new EnergyBars;
  strip_ = new EnergyStrip;
  QVBoxLayout* column = static_cast<QVBoxLayout*>(layout());
  column->addLayout(row);
  column->addWidget(bars_);
  column->addWidget(strip_, 1);
  connect(show_energy_, &QCheckBox::toggled, this, [this](bool shown) {
    bars_->setVisible(shown);
    strip_->setVisible(shown);
    Q_EMIT configChanged();
  });
}

void EnergyPanel::addValues()
{
  QGridLayout* grid = new QGridLayout;
  static_cast<QVBoxLayout*>(controls_->layout())->addLayout(grid);
  for (const ValueRow::Spec& spec : VALUES)
    values_.push_back(std::make_unique<ValueRow>(
        spec, grid, [this, name = spec.name](double value) { world_.setParameter(name, value); }));
}

void EnergyPanel::addButtons()
{
  QHBoxLayout* row = new QHBoxLayout;
  static_cast<QVBoxLayout*>(controls_->layout())->addLayout(row);
  const auto add = [&](const char* name, const char* label, QStyle::StandardPixmap icon, auto action) {
    QPushButton* button = new QPushButton(style()->standardIcon(icon), label);
    button->setObjectName(name);
    row->addWidget(button);
    connect(button, &QPushButton::clicked, this, action);
    return button;
  };
  pause_ = add("pause", "&Pause", QStyle::SP_MediaPause, [this] { world_.togglePause(); });
  step_ = add("step", "Step &1/60 s", QStyle::SP_MediaSeekForward, [this] { world_.step(); });
  reset_ = add("reset", "&Reset", QStyle::SP_MediaSkipBackward, [this] { world_.reset(); });

  world_name_ = new QLineEdit(topics::NODE);
  world_name_->setObjectName("world");
  world_name_->setToolTip("Name of the node that simulates the world");
  QLabel* label = new QLabel("&World");
  label->setBuddy(world_name_);
  QHBoxLayout* last = new QHBoxLayout;
  last->addWidget(label);
  last->addWidget(world_name_);
  static_cast<QVBoxLayout*>(layout())->addLayout(last);
  answer_ = new QLabel;
  answer_->setObjectName("answer");
  answer_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // a long text must not widen the panel
  layout()->addWidget(answer_);
  connect(world_name_, &QLineEdit::editingFinished, this, [this] {
    connectWorld();
    Q_EMIT configChanged();
  });
}

void EnergyPanel::connectWorld()
{
  const QString name = world_name_->text().trimmed();
  if (name == connected_)
    return;
  connected_ = name;
  energy_.reset();
  has_values_ = false;
  strip_->clear();
  answer_->clear();
  world_.connect(name.toStdString());
}

void EnergyPanel::onEnergy(const msg::Energy& message)
{
  energy_ = message;
  strip_->add(message.time, energiesOf(message));
}

void EnergyPanel::refresh()
{
  const bool there = world_.isThere();
  const bool paused = world_.isPaused();
  controls_->setEnabled(there && has_values_);  // a recording that is played has none
  step_->setEnabled(paused);
  pause_->setText(paused ? "&Play" : "&Pause");
  pause_->setIcon(style()->standardIcon(paused ? QStyle::SP_MediaPlay : QStyle::SP_MediaPause));

  if (!there)
    status_->setText("no world: " + QString::fromStdString(world_.name()));
  else if (!energy_)
    status_->setText("connected");
  else
    status_->setText(QString("%1 %2 s").arg(paused ? "paused at" : "running,").arg(energy_->time, 0, 'f', 1));
  if (!there || !energy_)
    return;
  bars_->show(energiesOf(*energy_));
  strip_->refresh();
}

void EnergyPanel::load(const rviz::Config& config)
{
  rviz::Panel::load(config);
  QString name;
  if (config.mapGetString("World", &name))
    world_name_->setText(name);
  bool shown = true;
  if (config.mapGetBool("Show Energy", &shown))
    show_energy_->setChecked(shown);
  connectWorld();
}

void EnergyPanel::save(rviz::Config config) const
{
  rviz::Panel::save(config);
  config.mapSetValue("World", world_name_->text());
  config.mapSetValue("Show Energy", show_energy_->isChecked());
}

}  // namespace block_world

PLUGINLIB_EXPORT_CLASS(block_world::EnergyPanel, rviz::Panel)
