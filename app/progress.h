#pragma once

#include <string>

namespace tessera {

/// Tells on standard error how far a long job is: a bar with the time left on a terminal, else a plain line at
/// each tenth.
class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// @param done    share of the work done, 0 to 1
    /// @param seconds wall time it took
    /// @param detail  such as "12 of 64 spp"
    void update(double done, double seconds, const std::string& detail);

private:
    std::string what_;
    bool terminal_;
    bool drawn_ = false;
    int tenths_ = 0;
    double drawn_at_ = -1;
};

} // namespace tessera
