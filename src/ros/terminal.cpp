#include "terminal.h"

#include <sys/ioctl.h>
#include <sys/select.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

namespace block_world
{
namespace
{
// Second screen without a cursor, and back.
constexpr char ENTER[] = "\033[?1049h\033[?25l";
constexpr char LEAVE[] = "\033[?25h\033[?1049l";

// For signal handlers, which can reach nothing else.
termios original;
volatile std::sig_atomic_t end_asked = 0;

void put(const char* text, std::size_t size)
{
  // A terminal that takes nothing more is gone: there is nobody to tell.
  if (::write(STDOUT_FILENO, text, size) < 0)
    end_asked = 1;
}

void enterRaw()
{
  termios raw = original;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  put(ENTER, sizeof(ENTER) - 1);
}

void restore()
{
  put(LEAVE, sizeof(LEAVE) - 1);
  tcsetattr(STDIN_FILENO, TCSANOW, &original);
}

void onEnd(int)
{
  end_asked = 1;
}

void onStop(int)
{
  restore();
  raise(SIGSTOP);
}

void onContinue(int)
{
  enterRaw();
}

void onCrash(int signal)
{
  restore();
  std::signal(signal, SIG_DFL);
  raise(signal);
}

void handle(int signal, void (*handler)(int))
{
  struct sigaction action = {};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

}  // namespace

Terminal::Terminal()
{
  if (!isatty(STDIN_FILENO) || !isatty(STDOUT_FILENO) || tcgetattr(STDIN_FILENO, &original) != 0)
    throw std::runtime_error("standard input and output must be a terminal");
  for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGQUIT })
    handle(signal, onEnd);
  for (const int signal : { SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL })
    handle(signal, onCrash);
  handle(SIGTSTP, onStop);
  handle(SIGCONT, onContinue);
  enterRaw();
}

Terminal::~Terminal()
{
  handle(SIGTSTP, SIG_DFL);
  handle(SIGCONT, SIG_DFL);
  restore();
}

bool Terminal::endAsked()
{
  return end_asked != 0;
}

std::vector<unsigned char> Terminal::read(int patience_ms)
{
  fd_set input;
  FD_ZERO(&input);
  FD_SET(STDIN_FILENO, &input);
  timeval patience = { patience_ms / 1000, patience_ms % 1000 * 1000 };
  std::vector<unsigned char> bytes;
  if (select(STDIN_FILENO + 1, &input, nullptr, nullptr, &patience) <= 0)
    return bytes;
  bytes.resize(64);
  const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (count <= 0)
    end_asked = 1;
  bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return bytes;
}

void Terminal::show(const std::vector<std::string>& lines)
{
  std::string text = "\033[H";
  for (const std::string& line : lines)
    text += line + "\033[K\r\n";
  text += "\033[J";
  put(text.data(), text.size());
}

int Terminal::columns() const
{
  winsize size = {};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return 80;
  return size.ws_col;
}

}  // namespace block_world
