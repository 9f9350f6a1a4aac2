#include "mis/math/large_vector.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstdint>

namespace mis {

void wish_for_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#if defined(__linux__)
    constexpr std::uintptr_t page = 4096;  // the smallest that there are; a wrong guess is refused
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page,
               end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace mis
