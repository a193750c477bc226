#include "simulate_output.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace block_world
{
namespace
{
const char* nameOf(ContactKind kind)
{
  switch (kind)
  {
    case ContactKind::Impact:
      return "impact";
    case ContactKind::RestBegin:
      return "rest_begin";
    case ContactKind::RestEnd:
      return "rest_end";
    case ContactKind::Rest:
      return "rest";
  }
  throw std::logic_error("contact of unknown kind");
}

std::unique_ptr<Table> openIfWanted(const std::string& path)
{
  return path.empty() ? nullptr : std::make_unique<Table>(path);
}

}  // namespace

Table::Table(const std::string& path) : path_(path), file_(stdout, &std::fflush)
{
  errno = 0;
  if (!path.empty())
    file_ = { std::fopen(path.c_str(), "w"), &std::fclose };
  if (!file_)
    fail("cannot be opened");
}

void Table::fail(const std::string& what) const
{
  throw std::runtime_error((path_.empty() ? "standard output" : path_) + ": " + what +
                           (errno == 0 ? "" : std::string(": ") + std::strerror(errno)));
}

void Table::separate()
{
  if (row_begun_)
    std::fputc(',', file_.get());
  row_begun_ = true;
}

void Table::add(double number)
{
  separate();
  std::fprintf(file_.get(), "%.17g", number);
}

void Table::add(const std::string& text)
{
  separate();
  std::fputs(text.c_str(), file_.get());
}

void Table::addHeader(const std::string& header)
{
  add(header);
  endRow();
}

void Table::endRow()
{
  std::fputc('\n', file_.get());
  row_begun_ = false;
}

void Table::close()
{
  errno = 0;
  if (std::fflush(file_.get()) != 0 || std::ferror(file_.get()))
    fail("cannot be written");
}

Output::Output(const std::string& states, const std::string& energy, const std::string& contacts)
  : states_(states), energy_(openIfWanted(energy)), contacts_(openIfWanted(contacts))
{
  // Only now, so that nothing is written where one of them cannot be opened.
  states_.addHeader("time,block,x,y,angle,vx,vy,omega");
  if (energy_)
    energy_->addHeader("time,gravity,spring,translational,rotational,total,thrust_work,spring_work,command_work,"
                       "damping_loss,impact_loss,"
                       "balance_error");
  if (contacts_)
    contacts_->addHeader("time,kind,a,b,x,y,nx,ny,normal_velocity,impulse");
}

void Output::write(const World& world, const Sample& sample)
{
  for (int body = 0; body < world.bodyCount(); ++body)
  {
    if (world.isFixed(body))
      continue;
    const MotionState& state = sample.states[body];
    states_.add(sample.time.seconds());
    states_.add(world.name(body));
    for (const double number :
         { state.position.x(), state.position.y(), state.angle, state.velocity.x(), state.velocity.y(), state.omega })
      states_.add(number);
    states_.endRow();
  }
  if (energy_)
  {
    const EnergyAccount& e = sample.energy;
    for (const double number :
         { sample.time.seconds(), e.gravity, e.spring, e.translational, e.rotational, e.total, e.thrust_work,
           e.spring_work, e.command_work, e.damping_loss, e.impact_loss, e.balance_error })
      energy_->add(number);
    energy_->endRow();
  }
  for (const ContactEvent& contact : sample.contacts)
    writeContact(world, contact);
  for (const ContactEvent& contact : sample.resting)
    writeContact(world, contact);
}

void Output::writeContact(const World& world, const ContactEvent& contact)
{
  contacts_->add(contact.time.seconds());
  contacts_->add(nameOf(contact.kind));
  contacts_->add(world.name(contact.a));
  contacts_->add(world.name(contact.b));
  for (const double number : { contact.point.x(), contact.point.y(), contact.normal.x(), contact.normal.y(),
                               contact.normal_velocity, contact.impulse })
    contacts_->add(number);
  contacts_->endRow();
}

void Output::close()
{
  states_.close();
  if (energy_)
    energy_->close();
  if (contacts_)
    contacts_->close();
}

}  // namespace block_world
