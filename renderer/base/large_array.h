// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace afterglow {

/// Memory for arrays of many megabytes: asks for huge pages, since the first touch of each page
/// costs more than filling it, and leaves new elements as they are where a type allows it.
template <class T>
struct LargeAllocator {
    using value_type = T;
    static constexpr std::size_t kHugePage = std::size_t(2) << 20;

    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < 2 * kHugePage)
            return static_cast<T*>(::operator new(bytes, std::align_val_t(alignof(T))));
        const std::size_t whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
        void* const memory = std::aligned_alloc(kHugePage, whole);
        if (memory == nullptr)
            throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
        madvise(memory, whole, MADV_HUGEPAGE); // a wish: without it all works, a little slower
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < 2 * kHugePage)
            ::operator delete(memory, std::align_val_t(alignof(T)));
        else
            std::free(memory);
    }
    template <class U>
    void construct(U* element) {
        ::new (static_cast<void*>(element)) U;
    }
    template <class U, class... Arguments>
    void construct(U* element, Arguments&&... arguments) {
        ::new (static_cast<void*>(element)) U(static_cast<Arguments&&>(arguments)...);
    }
    template <class U>
    bool operator==(const LargeAllocator<U>&) const {
        return true;
    }
};

/// An array that may be large. New elements without a value have no particular one.
template <class T>
using LargeArray = std::vector<T, LargeAllocator<T>>;

} // namespace afterglow
