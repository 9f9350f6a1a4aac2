#pragma once

#include <memory>
#include <mutex>
#include <vector>

namespace mis {

/// Things that threads borrow: as many as are ever out at once. Item is default-constructible.
template <class Item> class Pool {
public:
    /// body(item), with one that no other thread has.
    template <class Body> void with(const Body& body)
    {
        std::unique_ptr<Item> item = take();
        body(*item);
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(item));
    }

private:
    std::unique_ptr<Item> take()
    {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return std::make_unique<Item>();
        std::unique_ptr<Item> item = std::move(free_.back());
        free_.pop_back();
        return item;
    }
    std::mutex mutex_;
    std::vector<std::unique_ptr<Item>> free_;
};

}  // namespace mis
