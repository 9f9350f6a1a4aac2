#pragma once

#include <cstddef>

namespace mis {

/// How many times this program has asked for memory so far (operator new of every kind).
std::size_t allocations();

}  // namespace mis
