#include "drive_keys.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QElapsedTimer>

namespace block_world
{
namespace
{
using Levels = std::vector<double>;
const Levels NONE = { 0, 0, 0, 0, 0, 0 };
}  // namespace

class DriveKeysTest : public testing::Test
{
protected:
  bool press(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier, bool repeats = false)
  {
    return keys.handle(QKeyEvent(QEvent::KeyPress, key, modifiers, QString(), repeats));
  }
  bool release(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier, bool repeats = false)
  {
    return keys.handle(QKeyEvent(QEvent::KeyRelease, key, modifiers, QString(), repeats));
  }
  static void pass(int ms)
  {
    QElapsedTimer timer;
    for (timer.start(); timer.elapsed() < ms;)
      QCoreApplication::processEvents();
  }

  int changes = 0;
  DriveKeys keys{ [this] { ++changes; } };
};

TEST_F(DriveKeysTest, aKeyCountsFromPressToRelease)
{
  EXPECT_TRUE(press(Qt::Key_E));
  EXPECT_EQ(keys.levels(0), (Levels{ 0, 0, 1, 0, 0, 0 }));
  EXPECT_EQ(keys.levels(1), NONE);
  pass(50);
  EXPECT_EQ(changes, 1);
  EXPECT_TRUE(release(Qt::Key_E));
  pass(50);
  EXPECT_EQ(keys.levels(0), NONE);
  EXPECT_EQ(changes, 2);
}

TEST_F(DriveKeysTest, repetitionsChangeNothing)
{
  press(Qt::Key_E);
  for (int i = 0; i < 5; ++i)
  {
    release(Qt::Key_E, Qt::NoModifier, true);
    press(Qt::Key_E, Qt::NoModifier, true);
    pass(20);
    // Those that Qt does not mark.
    release(Qt::Key_E);
    press(Qt::Key_E);
    pass(20);
  }
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(keys.levels(0), (Levels{ 0, 0, 1, 0, 0, 0 }));
}

TEST_F(DriveKeysTest, aRepetitionThatComesLateInABusyLoopStillCounts)
{
  press(Qt::Key_E);
  release(Qt::Key_E);
  // The loop stands still for longer than a release may be revoked; the press waits behind the timer.
  QElapsedTimer timer;
  for (timer.start(); timer.elapsed() < 30;)
    ;
  QTimer::singleShot(0, [this] { press(Qt::Key_E); });
  pass(50);
  EXPECT_EQ(changes, 1);
}

TEST_F(DriveKeysTest, keysAddUp)
{
  press(Qt::Key_E);
  press(Qt::Key_F);
  press(Qt::Key_Up);
  EXPECT_EQ(keys.levels(0), (Levels{ 0, 1, 1, 0, 0, 1 }));
  EXPECT_EQ(keys.levels(1), (Levels{ 0, 0, 1, 0, 0, 0 }));
  release(Qt::Key_E);
  pass(20);
  EXPECT_EQ(keys.levels(0), (Levels{ 0, 1, 0, 0, 0, 1 }));
  keys.releaseAll();
  EXPECT_TRUE(keys.isIdle());
  EXPECT_EQ(keys.levels(1), NONE);
}

TEST_F(DriveKeysTest, shiftCountsAsItWasAtThePress)
{
  press(Qt::Key_S, Qt::ShiftModifier);
  const Levels spin = { 1, 0, 0, 0, 0, 1 };
  EXPECT_EQ(keys.levels(0), spin);
  // Shift is let go: the key repeats without it, and is let go without it.
  release(Qt::Key_S);
  press(Qt::Key_S);
  pass(20);
  EXPECT_EQ(keys.levels(0), spin);
  release(Qt::Key_S);
  pass(20);
  EXPECT_EQ(keys.levels(0), NONE);

  press(Qt::Key_Left, Qt::ShiftModifier);
  EXPECT_EQ(keys.levels(1), spin) << "arrows spin too";
  press(Qt::Key_E, Qt::ShiftModifier);
  EXPECT_EQ(keys.levels(0), (Levels{ 0, 0, 1, 0, 0, 0 })) << "what cannot spin drives on";
}

TEST_F(DriveKeysTest, othersKeysAreLeftAlone)
{
  EXPECT_FALSE(press(Qt::Key_S, Qt::ControlModifier)) << "rviz saves";
  EXPECT_FALSE(press(Qt::Key_Left, Qt::AltModifier));
  EXPECT_FALSE(press(Qt::Key_M));
  EXPECT_FALSE(press(Qt::Key_Escape));
  release(Qt::Key_E);  // was never pressed
  EXPECT_TRUE(keys.isIdle());
  EXPECT_EQ(changes, 0);
  press(Qt::Key_S);
  EXPECT_TRUE(release(Qt::Key_S, Qt::ControlModifier)) << "the end of a press of ours is ours";
  pass(20);
  EXPECT_TRUE(keys.isIdle());
}

}  // namespace block_world

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  QCoreApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
