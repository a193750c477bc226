// The panel in front of a real node: what it shows, and what its controls do.

#include "energy_panel.h"

#include <dynamic_reconfigure/Reconfigure.h>

#include <QApplication>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTest>

#include <algorithm>
#include <cmath>

#include "display.h"
#include "energy_bars.h"
#include "energy_strip.h"
#include "ros/node_client.h"

namespace block_world
{
class EnergyPanelTest : public testing::Test
{
protected:
  void SetUp() override
  {
    client.pause(true);
    client.reset();
    panel.resize(400, 700);
    panel.show();
    ASSERT_TRUE(wait([this] { return find<QPushButton>("step")->isEnabled() && field("thrust")->value() > 0.0; }));
  }

  static bool wait(const std::function<bool()>& condition, double seconds = 10.0)
  {
    return waitFor(
        [&] {
          QApplication::processEvents();
          return condition();
        },
        seconds);
  }

  static void pass(double seconds)
  {
    wait([] { return false; }, seconds);
  }

  template <class Widget>
  Widget* find(const std::string& name) const
  {
    Widget* widget = nullptr;
    for (QWidget* candidate : panel.findChildren<QWidget*>(QString::fromStdString(name)))
      widget = dynamic_cast<Widget*>(candidate);
    EXPECT_NE(widget, nullptr) << name;
    return widget;
  }
  QDoubleSpinBox* field(const std::string& name) const
  {
    return find<QDoubleSpinBox>(name + "_field");
  }
  QSlider* slider(const std::string& name) const
  {
    return find<QSlider>(name + "_slider");
  }
  std::string status() const
  {
    return find<QLabel>("status")->text().toStdString();
  }

  /// As a user does it.
  void type(const std::string& name, const char* text)
  {
    QDoubleSpinBox* const box = field(name);
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, text);
    QTest::keyClick(box, Qt::Key_Return);
  }
  void enterWorld(const char* name)
  {
    QLineEdit* const edit = find<QLineEdit>("world");
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, name);
    QTest::keyClick(edit, Qt::Key_Return);
  }
  void click(const char* button)
  {
    QTest::mouseClick(find<QPushButton>(button), Qt::LeftButton);
  }

  /// The value that the node has been given last.
  double told(const std::string& name) const
  {
    double value = std::nan("");
    for (const msg::Input& input : inputs.messages)
      for (std::size_t i = 0; i < input.names.size(); ++i)
        if (input.kind == static_cast<int>(msg::Input::SET) && input.names[i] == name)
          value = input.values[i];
    return value;
  }

  NodeClient client{ "block_world" };
  Listener<msg::Energy> energy{ client.topic(topics::ENERGY), 1000 };
  Listener<msg::Input> inputs{ client.topic(topics::INPUTS), 1000 };
  EnergyPanel panel;
};

TEST_F(EnergyPanelTest, theBarsAreTheEnergies)
{
  type("gravity", "3");
  ASSERT_TRUE(wait([this] { return told("gravity") == 3.0; }));
  client.advance(1.5);
  const ros::Time stamp = client.step(msg::Step::Request()).state.header.stamp;
  const EnergyStrip* const strip = find<EnergyStrip>("energy_strip");
  ASSERT_TRUE(wait([&] { return !energy.messages.empty() && energy.messages.back().header.stamp == stamp; }));
  const msg::Energy message = energy.messages.back();
  ASSERT_TRUE(wait([&] { return !strip->samples().empty() && strip->samples().back().time == message.time; }));
  pass(0.3);  // the panel draws 25 times a second

  const EnergyBars* const bars = find<EnergyBars>("energy_bars");
  const EnergyBars::Geometry g = bars->geometryOfBars();
  const double joule = (bars->scale().high() - bars->scale().low()) / g.area.width();
  ASSERT_GT(message.gravity, 10.0);
  ASSERT_GT(message.rotational, 0.01);
  EXPECT_NEAR(g.potential.width() * joule, message.gravity + message.spring, 1e-9);
  EXPECT_NEAR(g.rotational.width() * joule, message.rotational, 1e-9);
  EXPECT_NEAR(g.translational.width() * joule, message.translational, 1e-9);
  EXPECT_NEAR((g.total - g.zero) * joule, message.total, 1e-9);

  // Between two changes of gravity no energy comes or goes: the last 1.5 s are flat.
  int count = 0;
  for (const EnergyStrip::Sample& sample : strip->samples())
    if (sample.time > message.time - 1.4)
    {
      EXPECT_NEAR(sample.energies.total(), message.total, 1e-9);
      ++count;
    }
  EXPECT_GE(count, 50) << "60 Hz";
}

TEST_F(EnergyPanelTest, slidersChangeThePhysics)
{
  // Six steps of the keyboard's page keys: each is a tenth of 0 ... 20 m/s^2.
  type("gravity", "0");
  ASSERT_TRUE(wait([this] { return told("gravity") == 0.0 || std::isnan(told("gravity")); }));
  slider("gravity")->setFocus();
  for (int i = 0; i < 2; ++i)
    QTest::keyClick(slider("gravity"), Qt::Key_PageUp);
  ASSERT_TRUE(wait([this] { return told("gravity") == 4.0; })) << told("gravity");
  EXPECT_EQ(field("gravity")->value(), 4.0);
  // Free fall before anything is hit.
  const double before = client.advance(0.0)[2].vy;
  EXPECT_NEAR(client.advance(0.1)[2].vy, before - 4.0 * 0.1, 1e-12);

  type("gravity", "0");
  type("damping", "0.25");
  ASSERT_TRUE(wait([this] { return told("gravity") == 0.0 && told("damping") == 0.25; }));
  const double fast = client.advance(0.0)[2].vx;
  EXPECT_NEAR(client.advance(0.1)[2].vx, fast * std::exp(-0.25 * 0.1), 1e-12);

  type("damping", "0");
  type("thrust", "2.5");
  type("mass", "4");
  type("elasticity", "0.5");
  ASSERT_TRUE(wait([this] { return told("damping") == 0.0 && told("elasticity") == 0.5 && told("mass") == 4.0; }));
  msg::Step::Request push;
  push.duration = 0.1;
  push.thrust.emplace_back();
  push.thrust[0].body = "block1";
  push.thrust[0].levels = { 0, 0, 1, 0, 0, 0 };
  push.thrust[0].duration = 1.0;
  const msg::BodyState start = client.advance(0.0)[0];
  const msg::BodyState end = client.step(push).state.bodies[0];
  const double speed_up = std::hypot(end.vx - start.vx, end.vy - start.vy);
  // Thrust along the block's axis, which turns a little meanwhile: a chord instead of an arc, by less than omega^2 t^2
  // / 24.
  const double turned = start.omega * 0.1;
  EXPECT_NEAR(speed_up, 2.5 / 4.0 * 0.1, 2.5 / 4.0 * 0.1 * turned * turned);
}

TEST_F(EnergyPanelTest, aDraggedSliderEndsWhereItIsLetGo)
{
  QSlider* const bar = slider("elasticity");
  for (int position = bar->maximum(); position >= 0; --position)
  {
    bar->setValue(position);
    QApplication::processEvents();
  }
  bar->setValue(bar->maximum() / 4);
  ASSERT_TRUE(wait([this] { return told("elasticity") == 0.25; }));
  pass(0.5);
  EXPECT_EQ(told("elasticity"), 0.25);
  EXPECT_EQ(bar->value(), bar->maximum() / 4) << "older answers do not move it back";
  EXPECT_EQ(field("elasticity")->value(), 0.25);
}

TEST_F(EnergyPanelTest, theNumberOfBlocks)
{
  for (const char* count : { "6", "1", "3" })
  {
    type("count", count);
    EXPECT_TRUE(wait([&] { return client.advance(0.0).size() == static_cast<std::size_t>(std::atoi(count)); }))
        << count;
  }
  type("count", "7");
  EXPECT_TRUE(wait([this] { return field("count")->value() == 3.0; })) << "the scene has six: refused, shown as it is";
  EXPECT_EQ(client.advance(0.0).size(), 3u);
}

TEST_F(EnergyPanelTest, followsWhatOthersSet)
{
  dynamic_reconfigure::Reconfigure service;
  service.request.config.doubles.resize(2);
  service.request.config.doubles[0].name = "gravity";
  service.request.config.doubles[0].value = 7.25;
  service.request.config.doubles[1].name = "real_time_factor";
  service.request.config.doubles[1].value = 0.5;
  ASSERT_TRUE(ros::service::call(client.topic("set_parameters"), service));
  EXPECT_TRUE(wait([this] { return field("gravity")->value() == 7.25 && field("real_time_factor")->value() == 0.5; }));
  EXPECT_EQ(slider("gravity")->value(), std::lround(slider("gravity")->maximum() * 7.25 / 20));
  type("real_time_factor", "1");
  type("gravity", "0");
  EXPECT_TRUE(wait([this] { return told("gravity") == 0.0; }));
}

TEST_F(EnergyPanelTest, buttonsPlayPauseStepAndReset)
{
  type("gravity", "0");
  client.advance(0.5);
  const ros::Time at = client.step(msg::Step::Request()).state.header.stamp;
  ASSERT_TRUE(wait([this] { return find<QPushButton>("step")->isEnabled(); }));
  click("step");
  const auto isLaterThan = [&](ros::Time stamp) {
    return !energy.messages.empty() && energy.messages.back().header.stamp > stamp;
  };
  ASSERT_TRUE(wait([&] { return isLaterThan(at); }));
  EXPECT_EQ((energy.messages.back().header.stamp - at).toNSec(), 16666667);
  EXPECT_TRUE(wait([this] { return status().find("paused") != std::string::npos; })) << status();

  click("pause");
  ASSERT_TRUE(wait([&] { return isLaterThan(at + ros::Duration(0.3)); }));
  EXPECT_TRUE(wait([this] { return status().find("running") != std::string::npos; }));
  EXPECT_FALSE(find<QPushButton>("step")->isEnabled());
  click("pause");
  ASSERT_TRUE(wait([this] { return status().find("paused") != std::string::npos; }));

  client.advance(0.5);
  click("reset");
  EXPECT_TRUE(wait([this] { return client.advance(0.0)[0].x == -5.3; }));
}

TEST_F(EnergyPanelTest, aWorldMayBeAbsentComeLateAndHang)
{
  enterWorld("not a name");
  EXPECT_TRUE(wait([this] { return status() == "no world: not a name"; })) << status();
  EXPECT_FALSE(field("gravity")->isEnabled());
  enterWorld("later");
  EXPECT_TRUE(wait([this] { return status() == "no world: /later"; })) << status();

  Process later({ BLOCK_WORLD_NODE, "__name:=later", "_paused:=true", "_publish_clock:=false",
                  "_scene:=" BLOCK_WORLD_DIR "/config/scenes/stack.yaml" });
  ASSERT_TRUE(wait([this] { return field("gravity")->isEnabled() && field("gravity")->value() > 0.0; }));
  EXPECT_TRUE(wait([this] { return status().find("paused") != std::string::npos; })) << status();

  // A node that does not answer must not stop rviz.
  later.signal(SIGSTOP);
  click("reset");
  click("pause");
  QElapsedTimer timer;
  qint64 longest = 0;
  for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(2.5); ros::WallTime::now() < end;)
  {
    timer.start();
    QApplication::processEvents();
    longest = std::max(longest, timer.elapsed());
    QTest::qSleep(5);
  }
  EXPECT_LT(longest, 200) << "ms";
  EXPECT_NE(find<QLabel>("answer")->text().toStdString().find("no answer"), std::string::npos);
  later.signal(SIGCONT);
  later.end(SIGTERM);
  EXPECT_TRUE(wait([this] { return status() == "no world: /later"; })) << status();
  enterWorld("block_world");
  EXPECT_TRUE(wait([this] { return field("gravity")->isEnabled(); }));
}

TEST_F(EnergyPanelTest, remembersItsSettings)
{
  QCheckBox* const show = find<QCheckBox>("show_energy");
  EXPECT_TRUE(find<EnergyBars>("energy_bars")->isVisible());
  QTest::keyClick(show, Qt::Key_Space);
  EXPECT_FALSE(find<EnergyBars>("energy_bars")->isVisible());
  EXPECT_FALSE(find<EnergyStrip>("energy_strip")->isVisible());
  enterWorld("another");

  rviz::Config config;
  panel.save(config);
  EnergyPanel copy;
  copy.load(config);
  EXPECT_FALSE(copy.findChild<QCheckBox*>("show_energy")->isChecked());
  EXPECT_EQ(copy.findChild<QLineEdit*>("world")->text(), "another");
}

TEST_F(EnergyPanelTest, theKeyboardReachesEverything)
{
  panel.activateWindow();
  find<QCheckBox>("show_energy")->setFocus();
  std::vector<QWidget*> seen;
  for (int i = 0; i < 40; ++i)
  {
    seen.push_back(panel.focusWidget());
    QTest::keyClick(panel.focusWidget(), Qt::Key_Tab);
  }
  for (const char* name : { "gravity_slider", "gravity_field", "count_field", "real_time_factor_field", "pause", "step",
                            "reset", "world", "show_energy" })
    EXPECT_NE(std::find(seen.begin(), seen.end(), find<QWidget>(name)), seen.end()) << name;
}

}  // namespace block_world

int main(int argc, char** argv)
{
  qputenv("QT_QPA_PLATFORM", "offscreen");
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "energy_panel_rostest");
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
