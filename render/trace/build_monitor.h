#pragma once

#include <functional>

namespace tessera {

/// Watches the BVHs that the calling thread builds while this lives: whoever loads a scene is far from where its
/// BVH is built, and is the only one to watch.
class BuildMonitor {
public:
    /// Gets the share of a BVH that is done, [0, 1], from any of the threads that build it, several at once.
    /// False: it is wanted no more, and its constructor throws std::runtime_error.
    using Watcher = std::function<bool(double share)>;

    explicit BuildMonitor(Watcher watcher);
    ~BuildMonitor();
    BuildMonitor(const BuildMonitor&) = delete;
    BuildMonitor& operator=(const BuildMonitor&) = delete;

    /// The calling thread's newest; null: none.
    static const BuildMonitor* current();
    bool is_wanted(double share) const { return watcher_(share); }

private:
    Watcher watcher_;
    const BuildMonitor* outer_;
};

} // namespace tessera
