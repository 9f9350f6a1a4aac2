#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace mis {

/// Asks the system for large pages under memory that is not written yet (Linux: 2 MB each, where it
/// gives them on request). A wish: nothing is said where it is not granted.
void wish_for_large_pages(void* memory, std::size_t bytes);

/// Allocates as std::allocator does, with large pages from 4 MB on. What is read here and there in
/// the data of a million lights would else miss in the processor's table of pages nearly every
/// time.
template <class T> struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <class U> LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count)
    {
        constexpr std::size_t large = std::size_t{4} << 20;
        const std::size_t bytes = count * sizeof(T);
        void* memory = ::operator new(bytes, std::align_val_t(alignof(T)));
        if (bytes >= large) wish_for_large_pages(memory, bytes);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t)
    {
        ::operator delete(memory, std::align_val_t(alignof(T)));
    }
    friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

/// A vector of something of which there may be millions.
template <class T> using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace mis
