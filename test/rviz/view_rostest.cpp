// The main window of rviz with the shipped configuration, looked at from inside.

#include <rosgraph_msgs/Log.h>
#include <rviz/display_group.h>
#include <rviz/failed_panel.h>
#include <rviz/failed_tool.h>
#include <rviz/properties/status_property.h>
#include <rviz/tool_manager.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>

#include <QApplication>
#include <QLabel>

#include "display.h"
#include "ros/node_client.h"

namespace block_world
{
namespace
{
/// All entries of all displays that are not as they should be.
void findTrouble(const rviz::Property* property, std::vector<std::string>& trouble, int& seen)
{
  if (const auto* status = dynamic_cast<const rviz::StatusProperty*>(property))
  {
    ++seen;
    if (const_cast<rviz::StatusProperty*>(status)->getLevel() != rviz::StatusProperty::Ok)
      trouble.push_back((status->getName() + ": " + status->getValue().toString()).toStdString());
  }
  for (int i = 0; i < property->numChildren(); ++i)
    findTrouble(property->childAt(i), trouble, seen);
}

}  // namespace

TEST(View, toolAndPanelAreThereAndNothingComplains)
{
  Listener<rosgraph_msgs::Log> log("/rosout", 1000);
  rviz::VisualizationFrame frame;
  frame.setApp(qApp);
  frame.setSplashPath("");
  frame.initialize(BLOCK_WORLD_DIR "/config/block_world.rviz");
  frame.show();
  const auto pass = [](double seconds) {
    waitFor(
        [] {
          QApplication::processEvents();
          return false;
        },
        seconds);
  };
  pass(6.0);

  rviz::ToolManager* const tools = frame.getManager()->getToolManager();
  ASSERT_GT(tools->numTools(), 0);
  EXPECT_EQ(tools->getCurrentTool()->getClassId(), "block_world/Drive") << "ready to be driven";
  for (int i = 0; i < tools->numTools(); ++i)
    EXPECT_EQ(dynamic_cast<rviz::FailedTool*>(tools->getTool(i)), nullptr)
        << tools->getTool(i)->getName().toStdString();
  EXPECT_TRUE(frame.findChildren<rviz::FailedPanel*>().empty());
  EXPECT_EQ(frame.findChildren<QWidget*>("energy_bars").size(), 1);
  QLabel* const status = frame.findChild<QLabel*>("status");
  ASSERT_NE(status, nullptr);
  EXPECT_TRUE(status->text().startsWith("running")) << status->text().toStdString();

  std::vector<std::string> trouble;
  int seen = 0;
  findTrouble(frame.getManager()->getRootDisplayGroup(), trouble, seen);
  EXPECT_GE(seen, 4) << "displays tell how they are";
  EXPECT_TRUE(trouble.empty()) << trouble.front();

  for (const rosgraph_msgs::Log& line : log.messages)
    EXPECT_LT(line.level, static_cast<int>(rosgraph_msgs::Log::WARN)) << line.name << ": " << line.msg;
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "view_rostest");
  block_world::Display display;
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
