#include "render/trace/build_monitor.h"

#include <utility>

namespace tessera {

namespace {
thread_local const BuildMonitor* newest = nullptr;
} // namespace

BuildMonitor::BuildMonitor(Watcher watcher) : watcher_(std::move(watcher)), outer_(newest) {
    newest = this;
}

BuildMonitor::~BuildMonitor() {
    newest = outer_;
}

const BuildMonitor* BuildMonitor::current() {
    return newest;
}

} // namespace tessera
