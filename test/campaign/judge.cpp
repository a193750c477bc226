#include "judge.h"

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "copies.h"
#include "player.h"
#include "watch.h"

namespace campaign
{
namespace
{
using namespace block_world;

std::string quoted(const std::string& path)
{
  return "'" + path + "'";
}

std::string filesIn(const std::string& folder)
{
  return " --states " + quoted(folder + "/states.csv") + " --energy " + quoted(folder + "/energy.csv") +
         " --contacts " + quoted(folder + "/contacts.csv");
}

/// A run as the first one found it.
struct Watched
{
  std::uint64_t hash = 0;
  std::vector<ContactEvent> contacts;
};

/// One promise at a time, everything looked at after each.
Watched watch(const Case& item, const Tools& tools, Result& result)
{
  // Looking takes most of the time.
  Player player(item, 10.0 * tools.cpu);
  World& world = player.world();
  Watch watch(item, world, result);
  watch.look(world);
  player.finish([&] { watch.look(world); });
  if (!player.complaint().empty())
    result.fail("command", world.now().seconds(), player.complaint());
  result.events = world.statistics().events;
  result.impacts = world.statistics().impacts;
  return { world.stateHash(), watch.contacts() };
}

bool sameBits(const ContactEvent& p, const ContactEvent& q)
{
  return p.time == q.time && p.kind == q.kind && p.a == q.a && p.b == q.b && p.point == q.point &&
         p.normal == q.normal && p.normal_velocity == q.normal_velocity && p.impulse == q.impulse;
}

/// The same run read at other times: whether any bit depends on it.
void checkSampling(const Case& item, const Watched& wanted, const World& world, const Track& track, Result& result)
{
  const std::size_t common = std::min(wanted.contacts.size(), track.contacts.size());
  for (std::size_t i = 0; i < common; ++i)
    if (!sameBits(wanted.contacts[i], track.contacts[i]))
      return result.fail("sampling", wanted.contacts[i].time.seconds(), "a contact differs when read at other times");
  if (wanted.contacts.size() != track.contacts.size())
    return result.fail("sampling", item.duration, "the number of contacts differs when read at other times");
  if (world.stateHash() != wanted.hash || world.statistics().events != result.events)
    return result.fail("sampling", item.duration, "the end differs when read at other times");
}

void judgeInMemory(const Case& item, const Tools& tools, Result& result)
{
  Watched watched;
  if (tools.watches)
    watched = watch(item, tools, result);
  if (!tools.compares)
    return;
  Player player(item, tools.cpu);
  const double before = cpuSeconds();
  const Track track = read(item, player);
  result.cpu = cpuSeconds() - before;
  if (tools.watches)
    checkSampling(item, watched, player.world(), track, result);
  compareCopies(item, track, tools.cpu, result);
}

/// The failed checks of a report, as the checker prints them.
void readReport(const std::string& path, Result& result)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    // How much could be judged is a matter of the scene, not a fault of the run.
    if (line.rfind("FAILED", 0) != 0 || line.find(" coverage.") != std::string::npos)
      continue;
    std::istringstream words(line);
    std::string failed, name;
    double asked = 0.0, violated = 0.0, value = 0.0, limit = 0.0, time = 0.0;
    words >> failed >> name >> asked >> violated >> value >> limit;
    const std::size_t at = line.find("t=");
    if (at != std::string::npos)
      time = std::atof(line.c_str() + at + 2);
    const std::string told = line.substr(line.find(name) + name.size());
    result.fail("checker." + name, time, told.substr(0, told.find('(')));
  }
}

/// Exit status, or 128 and the signal, of a command for a shell.
int run(const std::string& command, double cpu)
{
  const int limit = static_cast<int>(std::ceil(cpu)) + 1;
  const int status = std::system(("ulimit -t " + std::to_string(limit) + "; " + command).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void judgeFiles(const Case& item, const Tools& tools, Result& result)
{
  const std::string scene = tools.folder + "/scene.yaml";
  saveCase(item, scene);
  const int simulated = run(simulateCommand(tools, scene, tools.folder, item.duration), 4.0 * tools.cpu);
  if (simulated != 0)
    return result.fail("simulate", item.duration, "status " + std::to_string(simulated));
  result.in_files = true;
  const std::string report = tools.folder + "/report";
  const int judged =
      run(checkerCommand(tools, scene, tools.folder) + " > " + quoted(report) + " 2>&1", 10.0 * tools.cpu);
  if (judged == 0)
    return;
  if (judged != 1)
    return result.fail("checker", item.duration, "status " + std::to_string(judged));
  readReport(report, result);
}
}  // namespace

Tools Tools::forCheck(const std::string& name) const
{
  const bool in_files = name.rfind("checker", 0) == 0 || name == "simulate";
  const bool in_copies = name == "mirrored" || name == "reordered";
  Tools tools = *this;
  if (!in_files)
    tools.simulate.clear();
  // What is stuck may be so in any run.
  const bool anywhere = name == "stuck" || name == "crash" || name == "exception";
  tools.watches = anywhere || !(in_files || in_copies);
  tools.compares = anywhere || in_copies || name == "sampling";
  return tools;
}

std::string simulateCommand(const Tools& tools, const std::string& scene, const std::string& folder, double duration)
{
  return quoted(tools.simulate) + " " + quoted(scene) + " --duration " + shown(duration) + " --sample 0.001" +
         filesIn(folder) + " 2> " + quoted(folder + "/log");
}

std::string checkerCommand(const Tools& tools, const std::string& scene, const std::string& folder)
{
  return quoted(tools.checker) + " " + quoted(scene) + filesIn(folder) + " --summary " + quoted(folder + "/log");
}

Result judge(const Case& item, const Tools& tools)
{
  Result result;
  try
  {
    judgeInMemory(item, tools, result);
    if (item.fitsSceneFile() && tools.judgesFiles())
      judgeFiles(item, tools, result);
  }
  catch (const Stuck& stuck)
  {
    result.fail("stuck", stuck.time(), stuck.what());
  }
  catch (const std::exception& error)
  {
    result.fail("exception", 0.0, error.what());
  }
  return result;
}

}  // namespace campaign
