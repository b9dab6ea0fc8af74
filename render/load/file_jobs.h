#pragma once

#include "recon/parallel.h"
#include "render/load/load_progress.h"
#include "render/load/xml_document.h"

#include <functional>
#include <string>
#include <vector>

namespace tessera {

/// The files that a scene names, read after the scene itself and all at once.
class FileJobs {
public:
    /// `read` runs later, on any thread, once; it returns a note, or nothing. `where` is the parameter that names
    /// the file: messages point at its value.
    void add(const XmlElement& where, std::function<std::string()> read);

    /// Runs all jobs. Throws LoadError for the first in order of the file that failed, std::runtime_error if the
    /// scene is given up on the way.
    void run(const ParallelFor& parallel_for, std::vector<LoadNote>& notes, LoadProgress& progress) const;

private:
    struct Job {
        XmlElement where;
        std::function<std::string()> read;
    };
    std::vector<Job> jobs_;
};

} // namespace tessera
