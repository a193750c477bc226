#include "apart.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace campaign
{
namespace
{
struct Child
{
  int number = 0;
  int pipe = -1;
};

void limitResources(double cpu)
{
  rlimit time;
  time.rlim_cur = static_cast<rlim_t>(std::ceil(cpu));
  time.rlim_max = time.rlim_cur + 1;
  setrlimit(RLIMIT_CPU, &time);
  rlimit core{ 0, 0 };
  setrlimit(RLIMIT_CORE, &core);
}

[[noreturn]] void work(const std::function<Result()>& task, double cpu, int pipe)
{
  limitResources(cpu);
  std::string text;
  try
  {
    text = pack(task());
  }
  catch (const std::exception& error)
  {
    Result result;
    result.fail("exception", 0.0, error.what());
    text = pack(result);
  }
  // A pipe holds this much, so that nobody need read while the work is done.
  text.resize(std::min<std::size_t>(text.size(), 60000));
  const bool written = write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  _exit(written ? 0 : 1);
}

/// Starts a process; returns its id.
pid_t start(const std::function<Result()>& task, double cpu, int& reading_end)
{
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("no pipe");
  std::fflush(nullptr);
  const pid_t id = fork();
  if (id < 0)
    throw std::runtime_error("no process");
  if (id == 0)
  {
    close(ends[0]);
    work(task, cpu, ends[1]);
  }
  close(ends[1]);
  reading_end = ends[0];
  return id;
}

Result collect(int pipe, int status)
{
  std::string text;
  char buffer[4096];
  for (ssize_t got; (got = read(pipe, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(got));
  close(pipe);
  Result result;
  if (WIFSIGNALED(status))
    result.fail(WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL ? "stuck" : "crash", 0.0,
                "ended by signal " + std::to_string(WTERMSIG(status)));
  else
    result = unpack(text);
  return result;
}
}  // namespace

Result apart(const std::function<Result()>& task, double cpu)
{
  int pipe = -1, status = 0;
  const pid_t id = start(task, cpu, pipe);
  waitpid(id, &status, 0);
  return collect(pipe, status);
}

void eachApart(int count, int jobs, const std::function<Result(int)>& task, double cpu,
               const std::function<void(int, const Result&)>& done)
{
  std::map<pid_t, Child> running;
  for (int next = 0; next < count || !running.empty();)
  {
    if (next < count && static_cast<int>(running.size()) < jobs)
    {
      Child child;
      child.number = next++;
      const int number = child.number;
      const pid_t id = start([&task, number] { return task(number); }, cpu, child.pipe);
      running[id] = child;
      continue;
    }
    int status = 0;
    const pid_t id = waitpid(-1, &status, 0);
    const auto found = running.find(id);
    if (found == running.end())
      continue;
    done(found->second.number, collect(found->second.pipe, status));
    running.erase(found);
  }
}

}  // namespace campaign
