#pragma once

#include <functional>
#include <string>
#include <vector>

#include "result.h"

namespace campaign
{
/// Does work in a process of its own, so that what crashes or hangs takes nothing else along. A limit on its CPU time,
/// s.
Result apart(const std::function<Result()>& work, double cpu);

/// The same for items 0 to count - 1, `jobs` at a time; `done` gets the results as they come.
void eachApart(int count, int jobs, const std::function<Result(int)>& work, double cpu,
               const std::function<void(int, const Result&)>& done);

}  // namespace campaign
