#include "result.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <sstream>

namespace campaign
{
std::string shown(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string pack(const Result& r)
{
  std::ostringstream out;
  out << std::setprecision(17) << r.seed << ' ' << r.events << ' ' << r.impacts << ' ' << r.rests << ' '
      << r.hits_together << ' ' << r.keeps_momentum << ' ' << r.keeps_energy << ' ' << r.in_files << ' ' << r.discontinuous << ' ' << r.overlap
      << ' ' << r.gain << ' ' << r.balance << ' ' << r.momentum << ' ' << r.departure << ' ' << r.compared << ' '
      << r.cpu << '\n'
      << r.saved << '\n';
  for (const Failure& failure : r.failures)
  {
    std::string detail = failure.detail;
    std::replace(detail.begin(), detail.end(), '\n', ' ');
    out << failure.check << ' ' << failure.time << ' ' << detail << '\n';
  }
  return out.str();
}

Result unpack(const std::string& text)
{
  Result r;
  std::istringstream in(text);
  in >> r.seed >> r.events >> r.impacts >> r.rests >> r.hits_together >> r.keeps_momentum >> r.keeps_energy >>
      r.in_files >> r.discontinuous >> r.overlap >> r.gain >> r.balance >> r.momentum >> r.departure >> r.compared >> r.cpu;
  in.ignore();
  std::getline(in, r.saved);
  Failure failure;
  while (in >> failure.check >> failure.time)
  {
    in.ignore();
    std::getline(in, failure.detail);
    r.failures.push_back(failure);
  }
  return r;
}

}  // namespace campaign
