#pragma once

#include <map>
#include <mutex>
#include <string>

namespace mis {

/// Values by name, each made by whoever asks for it first; others who ask wait
/// for it meanwhile.
template <class Value> class MadeOnce {
public:
    /// What make() gave the first time that this name was asked for. Where it
    /// throws, nothing is kept.
    template <class Make> Value get(const std::string& name, const Make& make)
    {
        const std::lock_guard lock(mutex_);
        const auto found = made_.find(name);
        return found != made_.end() ? found->second : made_.emplace(name, make()).first->second;
    }

private:
    std::mutex mutex_;
    std::map<std::string, Value> made_;
};

}  // namespace mis
