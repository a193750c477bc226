#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "block_world/time.h"
#include "geometry.h"

namespace block_world
{
/// 64-bit FNV-1a, continued from a former value.
inline std::uint64_t fnv1a(const void* data, std::size_t size, std::uint64_t hash = 14695981039346656037ull)
{
  const unsigned char* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i)
    hash = (hash ^ bytes[i]) * 1099511628211ull;
  return hash;
}

/// An archive goes through a value part by part: archive(a, b, ...) calls exchange(archive, part) for each, which goes on to the parts of the
/// part. The same function lists them for writing, reading and hashing. Instants go through time(), spans of time through span().
template <class Derived>
class Archive
{
public:
  template <class... Part>
  void operator()(Part&... part)
  {
    (exchange(static_cast<Derived&>(*this), part), ...);
  }
};

/// Appends the raw bits to a string.
class Writer : public Archive<Writer>
{
public:
  void raw(void* data, std::size_t size)
  {
    bytes.append(static_cast<const char*>(data), size);
  }
  void span(Time& time)
  {
    std::int64_t second = time.wholeSeconds();
    double fraction = time.fraction();
    (*this)(second, fraction);
  }
  void time(Time& time)
  {
    span(time);
  }
  template <class Container>
  void resize(Container& container)
  {
    std::uint64_t size = container.size();
    (*this)(size);
  }

  std::string bytes;
};

/// Takes the bits out again. Every instant comes out later by whole seconds, which changes no bit of what follows.
class Reader : public Archive<Reader>
{
public:
  Reader(const char* data, std::size_t size, std::int64_t seconds_later) : data_(data), left_(size), seconds_later_(seconds_later)
  {
  }
  void raw(void* data, std::size_t size)
  {
    if (size > left_)
      throw std::runtime_error("the state ends too early");
    std::memcpy(data, data_, size);
    data_ += size;
    left_ -= size;
  }
  void span(Time& time)
  {
    std::int64_t second;
    double fraction;
    (*this)(second, fraction);
    // Sums of whole numbers and of a fraction with zero: exact.
    const bool infinite = second == Time::infinity().wholeSeconds();
    time = infinite ? Time::infinity() : Time() + static_cast<double>(second) + fraction;
  }
  void time(Time& time)
  {
    span(time);
    time = time + static_cast<double>(seconds_later_);
  }
  template <class Container>
  void resize(Container& container)
  {
    std::uint64_t size;
    (*this)(size);
    if (size > left_)  // no part takes less than a byte
      throw std::runtime_error("the state ends too early");
    container.resize(size);
  }
  std::size_t left() const
  {
    return left_;
  }

private:
  const char* data_;
  std::size_t left_;
  std::int64_t seconds_later_;
};

/// Hashes the raw bits; instants relative to the whole seconds of a start, so that two runs compare whenever they began.
class Hasher : public Archive<Hasher>
{
public:
  explicit Hasher(const Time& start) : second_(start.wholeSeconds())
  {
  }
  void raw(void* data, std::size_t size)
  {
    hash = fnv1a(data, size, hash);
  }
  void span(Time& time)
  {
    std::int64_t second = time.wholeSeconds();
    double fraction = time.fraction();
    (*this)(second, fraction);
  }
  void time(Time& time)
  {
    std::int64_t second = time.isInfinite() ? time.wholeSeconds() : time.wholeSeconds() - second_;
    double fraction = time.fraction();
    (*this)(second, fraction);
  }
  template <class Container>
  void resize(Container& container)
  {
    std::uint64_t size = container.size();
    (*this)(size);
  }

  std::uint64_t hash = fnv1a(nullptr, 0);

private:
  std::int64_t second_;
};

template <class A, class T>
std::enable_if_t<std::is_arithmetic<T>::value> exchange(A& archive, T& value)
{
  archive.raw(&value, sizeof value);
}

template <class A>
void exchange(A& archive, Time& time)
{
  archive.time(time);
}

template <class A>
void exchange(A& archive, Vec2& vector)
{
  archive(vector.x(), vector.y());
}

template <class A>
void exchange(A& archive, std::string& text)
{
  archive.resize(text);
  archive.raw(&text[0], text.size());
}

template <class A, class T, std::size_t N>
void exchange(A& archive, std::array<T, N>& values)
{
  for (T& value : values)
    archive(value);
}

template <class A, class T>
void exchange(A& archive, std::vector<T>& values)
{
  archive.resize(values);
  for (T& value : values)
    archive(value);
}

template <class A, class T>
void exchange(A& archive, std::optional<T>& value)
{
  bool given = value.has_value();
  archive(given);
  if (given && !value)
    value.emplace();
  if (given)
    archive(*value);
  else
    value.reset();
}

template <class Variant, std::size_t... I>
void choose(Variant& variant, std::uint8_t index, std::index_sequence<I...>)
{
  ((index == I ? static_cast<void>(variant.template emplace<I>()) : static_cast<void>(0)), ...);
}

template <class A, class... T>
void exchange(A& archive, std::variant<T...>& variant)
{
  std::uint8_t index = static_cast<std::uint8_t>(variant.index());
  archive(index);
  if (index >= sizeof...(T))
    throw std::runtime_error("the state holds a command of a kind that there is not");
  if (index != variant.index())
    choose(variant, index, std::index_sequence_for<T...>());
  std::visit([&archive](auto& value) { archive(value); }, variant);
}

/// For those with private parts: their member function exchange.
template <class A, class T>
auto exchange(A& archive, T& value) -> decltype(value.exchange(archive))
{
  value.exchange(archive);
}

}  // namespace block_world
