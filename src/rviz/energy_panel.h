#pragma once

#include <rviz/panel.h>

#include <QTimer>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "value_row.h"
#include "world_client.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace block_world
{
class EnergyBars;
class EnergyStrip;

/// The energies of a world as bars and as lines, and everything about the world that may be changed while it runs.
class EnergyPanel : public rviz::Panel
{
public:
  explicit EnergyPanel(QWidget* parent = nullptr);

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

private:
  void addEnergies();
  void addValues();
  void addButtons();
  void connectWorld();
  void onEnergy(const msg::Energy& message);
  void refresh();

  WorldClient world_;
  QString connected_;  ///< name of the world that world_ is connected to
  std::optional<msg::Energy> energy_;
  bool has_values_ = false;  ///< the world has told its live parameters

  EnergyBars* bars_;
  EnergyStrip* strip_;
  QCheckBox* show_energy_;
  QLabel* status_;
  QWidget* controls_;
  std::vector<std::unique_ptr<ValueRow>> values_;
  QPushButton *pause_, *step_, *reset_;
  QLineEdit* world_name_;
  QLabel* answer_;  ///< of the last button pressed
  QTimer refresh_timer_;
};

}  // namespace block_world
