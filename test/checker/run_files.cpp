#include "run_files.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace checker
{
namespace
{
const char states_header[] = "time,block,x,y,angle,vx,vy,omega";
const char energy_header[] = "time,gravity,spring,translational,rotational,total,thrust_work,spring_work,command_work,"
                             "damping_loss,impact_loss,balance_error";
const char contacts_header[] = "time,kind,a,b,x,y,nx,ny,normal_velocity,impulse";

std::string slurp(const std::string& path)
{
  FILE* file = std::fopen(path.c_str(), "rb");
  if (!file)
    throw std::runtime_error(path + ": cannot be read");
  std::string text;
  char buffer[1 << 16];
  while (const size_t got = std::fread(buffer, 1, sizeof buffer, file))
    text.append(buffer, got);
  std::fclose(file);
  return text;
}

/// Walks over the fields of a table in memory; a file of a million rows is parsed in about a second.
class Cursor
{
public:
  Cursor(const std::string& text, const char* header, Check& numbers)
    : at_(text.c_str()), header_(header), numbers_(numbers)
  {
    const size_t length = std::strlen(header);
    if (text.compare(0, length, header) != 0 || (at_[length] != '\n' && at_[length] != '\r'))
      throw std::runtime_error(std::string("no table with the header ") + header);
    at_ = std::strchr(at_, '\n') + 1;
  }

  bool atEnd() const
  {
    return *at_ == '\0';
  }

  double number()
  {
    char* end = nullptr;
    const double value = std::strtod(at_, &end);
    if (end == at_ || (*end != ',' && *end != '\n' && *end != '\r' && *end != '\0'))
      fail("a number is missing");
    at_ = end;
    skipSeparator();
    if (time_ != time_)
      time_ = value;
    numbers_.add(std::isfinite(value) ? 0.0 : 1.0, 0.0, time_);
    return value;
  }

  std::string word()
  {
    const size_t length = std::strcspn(at_, ",\r\n");
    std::string value(at_, length);
    at_ += length;
    skipSeparator();
    return value;
  }

  void endRow()
  {
    if (!row_ended_ && *at_ != '\0')
      fail("a row has too many columns");
    row_ended_ = false;
    time_ = std::numeric_limits<double>::quiet_NaN();
    ++line_;
  }

private:
  void skipSeparator()
  {
    if (row_ended_)
      fail("a row has too few columns");
    if (*at_ == ',')
    {
      ++at_;
      return;
    }
    if (*at_ == '\r')
      ++at_;
    if (*at_ == '\n')
      ++at_;
    row_ended_ = true;
  }

  [[noreturn]] void fail(const std::string& reason) const
  {
    throw std::runtime_error("line " + std::to_string(line_) + " of the table " + header_ + ": " + reason);
  }

  const char* at_;
  const char* header_;
  Check& numbers_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
  bool row_ended_ = false;
  long line_ = 2;
};

int lookUp(const Scene& scene, const std::string& name, Check& names, double time)
{
  const auto found = scene.index.find(name);
  names.add(found == scene.index.end() ? 1.0 : 0.0, 0.0, time);
  return found == scene.index.end() ? -1 : found->second;
}

Kind kindOf(const std::string& word, Check& names, double time)
{
  if (word == "rest")
    return Kind::Rest;
  if (word == "rest_begin")
    return Kind::RestBegin;
  if (word == "rest_end")
    return Kind::RestEnd;
  names.add(word == "impact" ? 0.0 : 1.0, 0.0, time);
  return Kind::Impact;
}

/// Collects the rows of one sample after the other: every movable block exactly once.
class SampleCollector
{
public:
  SampleCollector(const Scene& scene, Run& run, Check& rows) : scene_(scene), run_(run), rows_(rows)
  {
  }

  void add(double time, int body, const State& state)
  {
    if (run_.times.empty() || time != run_.times.back())
      open(time);
    seen_[body] += 1;
    run_.states[(run_.times.size() - 1) * run_.bodies + body] = state;
  }

  void close()
  {
    for (size_t body = 0; !run_.times.empty() && body < seen_.size(); ++body)
    {
      const int expected = scene_.blocks[body].fixed ? 0 : 1;
      rows_.add(seen_[body] == expected ? 0.0 : 1.0, 0.0, run_.times.back(), static_cast<int>(body));
    }
  }

private:
  void open(double time)
  {
    close();
    seen_.assign(run_.bodies, 0);
    run_.times.push_back(time);
    for (const Block& block : scene_.blocks)
      run_.states.push_back(block.start);
  }

  const Scene& scene_;
  Run& run_;
  Check& rows_;
  std::vector<int> seen_;
};

void parseStates(const std::string& text, const Scene& scene, Run& run, Report& report)
{
  Check& names = report.check("file.names");
  Check& rows = report.check("file.rows");
  Cursor cursor(text, states_header, report.check("file.numbers"));
  SampleCollector samples(scene, run, rows);
  while (!cursor.atEnd())
  {
    const double time = cursor.number();
    const int body = lookUp(scene, cursor.word(), names, time);
    State state;
    state.position.x() = cursor.number();
    state.position.y() = cursor.number();
    state.angle = cursor.number();
    state.velocity.x() = cursor.number();
    state.velocity.y() = cursor.number();
    state.omega = cursor.number();
    cursor.endRow();
    if (body >= 0 && !scene.isWall(body))
      samples.add(time, body, state);
    else
      rows.add(1.0, 0.0, time);
  }
  samples.close();
  rows.add(run.times.empty() ? 1.0 : 0.0, 0.0, 0.0);
}

void parseEnergy(const std::string& text, Run& run, Report& report)
{
  Cursor cursor(text, energy_header, report.check("file.numbers"));
  while (!cursor.atEnd())
  {
    EnergyRow row;
    for (double* column :
         { &row.time, &row.gravity, &row.spring, &row.translational, &row.rotational, &row.total, &row.thrust_work,
           &row.spring_work, &row.command_work, &row.damping_loss, &row.impact_loss, &row.balance_error })
      *column = cursor.number();
    cursor.endRow();
    run.energy.push_back(row);
  }
}

void parseContacts(const std::string& text, const Scene& scene, Run& run, Report& report)
{
  Check& names = report.check("file.names");
  Cursor cursor(text, contacts_header, report.check("file.numbers"));
  while (!cursor.atEnd())
  {
    ContactRow row;
    row.time = cursor.number();
    row.kind = kindOf(cursor.word(), names, row.time);
    row.a = lookUp(scene, cursor.word(), names, row.time);
    row.b = lookUp(scene, cursor.word(), names, row.time);
    for (double* column :
         { &row.point.x(), &row.point.y(), &row.normal.x(), &row.normal.y(), &row.normal_velocity, &row.impulse })
      *column = cursor.number();
    cursor.endRow();
    if (row.a >= 0 && row.b >= 0)
    {
      names.add(row.a != row.b && (scene.movable(row.a) || scene.movable(row.b)) ? 0.0 : 1.0, 0.0, row.time, row.a,
                row.b);
      run.contacts.push_back(row);
    }
  }
}

void checkTimes(const Run& run, Report& report)
{
  Check& times = report.check("file.times");
  for (size_t k = 0; k < run.times.size(); ++k)
    times.add(k == 0 ? std::abs(run.times[0]) : run.times[k] > run.times[k - 1] ? 0.0 : 1.0, 0.0, run.times[k]);
  times.add(run.energy.size() == run.times.size() ? 0.0 : 1.0, 0.0, 0.0);
  for (size_t k = 0; k < std::min(run.energy.size(), run.times.size()); ++k)
    times.add(run.energy[k].time == run.times[k] ? 0.0 : 1.0, 0.0, run.times[k]);
  size_t sample = 0;
  for (size_t i = 0; i < run.contacts.size() && !run.times.empty(); ++i)
  {
    const ContactRow& row = run.contacts[i];
    const bool ordered = i == 0 ? row.time >= 0.0 : row.time >= run.contacts[i - 1].time;
    times.add(ordered && row.time <= run.times.back() ? 0.0 : 1.0, 0.0, row.time, row.a, row.b);
    while (sample + 1 < run.times.size() && run.times[sample] < row.time)
      ++sample;
    if (row.kind == Kind::Rest)
      times.add(row.time == run.times[sample] ? 0.0 : 1.0, 0.0, row.time, row.a, row.b);
  }
}
}  // namespace

Run parseRun(const std::string& states, const std::string& energy, const std::string& contacts, const Scene& scene,
             Report& report)
{
  report.check("file.numbers", "every number is finite");
  report.check("file.names", "bodies and kinds are known");
  report.check("file.rows", "every movable block once per sample");
  report.check("file.times", "times grow, start at 0 and agree between the files");
  Run run;
  run.bodies = scene.blocks.size();
  parseStates(states, scene, run, report);
  parseEnergy(energy, run, report);
  parseContacts(contacts, scene, run, report);
  checkTimes(run, report);
  return run;
}

Run readRun(const RunPaths& paths, const Scene& scene, Report& report)
{
  return parseRun(slurp(paths.states), slurp(paths.energy), slurp(paths.contacts), scene, report);
}

void checkSummary(const std::string& text, const Scene& scene, Report& report)
{
  const size_t start = text.rfind("summary: ");
  if (start == std::string::npos)
    throw std::runtime_error("no summary line");
  const std::string line = text.substr(start, text.find('\n', start) - start);
  const auto field = [&](const std::string& key) {
    const size_t found = line.find(" " + key + "=");
    return found == std::string::npos ? std::string() : line.substr(found + key.size() + 2);
  };
  const std::string mode = field("mode").substr(0, field("mode").find(' '));
  report.check("summary.mode", "every island was simulated exactly").add(mode == "exact" ? 0.0 : 1.0, 0.0, 0.0);
  const std::string overlap = field("worst_overlap_m");
  report.check("summary.overlap", "worst overlap that the run itself met, m")
      .add(overlap.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(overlap.c_str(), nullptr),
           scene.tolerance, 0.0);
}

}  // namespace checker
