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
    if (begin >= end) return;
    auto* const pages = reinterpret_cast<void*>(begin);
    if (madvise(pages, end - begin, MADV_HUGEPAGE) != 0) return;
    // What the heap hands out again lies in small pages as yet (Linux 6.1 and later).
    constexpr int collapse = 25;  // MADV_COLLAPSE, which the C library's headers may not know
    madvise(pages, end - begin, collapse);
#endif
}

}  // namespace mis
