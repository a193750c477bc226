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
  return " --states " + quoted(folder + "/states.csv") + " --energy " + quoted(folder + "/energy.csv") + " --contacts " +
         quoted(folder + "/contacts.csv");
}

/// One promise at a time, everything looked at after each.
std::uint64_t watched(const Case& item, const Tools& tools, Result& result, std::vector<ContactEvent>& contacts)
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
  contacts = watch.contacts();
  return world.stateHash();
}

bool sameBits(const ContactEvent& p, const ContactEvent& q)
{
  return p.time == q.time && p.kind == q.kind && p.a == q.a && p.b == q.b && p.point == q.point &&
         p.normal == q.normal && p.normal_velocity == q.normal_velocity && p.impulse == q.impulse;
}

/// The same run read at other times: whether any bit depends on it.
void checkSampling(const Case& item, const Tools& tools, std::uint64_t hash, const std::vector<ContactEvent>& contacts, Result& result)
{
  Player player(item, tools.cpu);
  const double before = cpuSeconds();
  const Track track = read(item, player);
  result.cpu = cpuSeconds() - before;
  const std::size_t common = std::min(contacts.size(), track.contacts.size());
  for (std::size_t i = 0; i < common; ++i)
    if (!sameBits(contacts[i], track.contacts[i]))
      return result.fail("sampling", contacts[i].time.seconds(), "a contact differs when read at other times");
  if (contacts.size() != track.contacts.size())
    return result.fail("sampling", item.duration, "the number of contacts differs when read at other times");
  if (player.world().stateHash() != hash || player.world().statistics().events != result.events)
    return result.fail("sampling", item.duration, "the end differs when read at other times");
  compareCopies(item, track, tools.cpu, result);
}

/// The failed checks of a report, as the checker prints them.
void readReport(const std::string& path, Result& result)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind("FAILED", 0) != 0)
      continue;
    std::istringstream words(line);
    std::string failed, name;
    double asked = 0.0, violated = 0.0, value = 0.0, limit = 0.0, time = 0.0;
    words >> failed >> name >> asked >> violated >> value >> limit;
    const std::size_t at = line.find("t=");
    if (at != std::string::npos)
      time = std::atof(line.c_str() + at + 2);
    result.fail("checker." + name, time, line.substr(line.find(name) + name.size()));
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
  const int judged = run(checkerCommand(tools, scene, tools.folder) + " > " + quoted(report) + " 2>&1", 10.0 * tools.cpu);
  if (judged == 0)
    return;
  const std::size_t before = result.failures.size();
  readReport(report, result);
  if (result.failures.size() == before)
    result.fail("checker", item.duration, "status " + std::to_string(judged));
}
}  // namespace

std::string simulateCommand(const Tools& tools, const std::string& scene, const std::string& folder, double duration)
{
  return quoted(tools.simulate) + " " + quoted(scene) + " --duration " + shown(duration) + " --sample 0.001" + filesIn(folder) + " 2> " +
         quoted(folder + "/log");
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
    std::vector<ContactEvent> contacts;
    const std::uint64_t hash = watched(item, tools, result, contacts);
    checkSampling(item, tools, hash, contacts, result);
    if (item.fitsSceneFile() && !tools.simulate.empty())
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
