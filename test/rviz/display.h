#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace block_world
{
/// A child process, ended with its owner.
class Process
{
public:
  explicit Process(std::vector<std::string> command)
  {
    std::vector<char*> arguments;
    for (std::string& word : command)
      arguments.push_back(&word[0]);
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0)
    {
      execvp(arguments[0], arguments.data());
      std::perror(arguments[0]);
      _exit(127);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process()
  {
    signal(SIGCONT);
    end(SIGTERM);
  }

  /// Sends the signal and waits; the exit status as waitpid has it.
  int end(int signal)
  {
    if (pid_ <= 0)
      return 0;
    this->signal(signal);
    return wait();
  }

  void signal(int number) const
  {
    if (pid_ > 0)
      kill(pid_, number);
  }

  int wait()
  {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return status;
  }

private:
  pid_t pid_;
};

/// A screen that nobody sees, drawn by the processor. From here on this process and its children use it.
class Display
{
public:
  Display()
  {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    server_ = std::make_unique<Process>(std::vector<std::string>{ "Xvfb", "-displayfd", std::to_string(ends[1]),
                                                                  "-screen", "0", "1280x900x24", "-nolisten", "tcp" });
    close(ends[1]);
    char number[16] = {};
    const ssize_t size = read(ends[0], number, sizeof(number) - 1);
    close(ends[0]);
    EXPECT_GT(size, 0) << "Xvfb did not start";
    const std::string name = ":" + std::to_string(std::atoi(number));
    setenv("DISPLAY", name.c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("QT_QPA_PLATFORM", "xcb", 1);
  }

private:
  std::unique_ptr<Process> server_;
};

/// Moves mouse and keys of the display. One xdotool serves all commands, so that they act without the delay of its
/// start.
class Controls
{
public:
  Controls() : pipe_(popen("xdotool -", "w"))
  {
    EXPECT_TRUE(pipe_ != nullptr);
  }
  ~Controls()
  {
    pclose(pipe_);
  }
  void operator()(const std::string& command)
  {
    std::fprintf(pipe_, "%s\n", command.c_str());
    std::fflush(pipe_);
  }

private:
  std::FILE* pipe_;
};

}  // namespace block_world
