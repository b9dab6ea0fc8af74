#include "render/load/file_jobs.h"

#include <exception>
#include <optional>

namespace tessera {

void FileJobs::add(const XmlElement& where, std::function<std::string()> read) {
    jobs_.push_back({where, std::move(read)});
}

void FileJobs::run(const ParallelFor& parallel_for, std::vector<LoadNote>& notes, LoadProgress& progress) const {
    progress.begin(LoadProgress::Stage::files, static_cast<int>(jobs_.size()));
    struct Outcome {
        std::string note;
        std::optional<std::string> error;
    };
    std::vector<Outcome> outcomes(jobs_.size());
    parallel_for(static_cast<int>(jobs_.size()), [&](int i) {
        if (progress.given_up())
            return;
        const auto index = static_cast<std::size_t>(i);
        try {
            outcomes[index].note = jobs_[index].read();
        } catch (const std::exception& e) {
            outcomes[index].error = e.what();
        }
        progress.step();
    });
    progress.check_wanted();
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
        const XmlElement& where = jobs_[i].where;
        const std::string file = "'" + where.attribute("value") + "'";
        if (outcomes[i].error)
            where.fail("cannot load " + file + ": " + *outcomes[i].error, "value");
        if (!outcomes[i].note.empty())
            notes.push_back({where.position(), file + ": " + outcomes[i].note});
    }
}

} // namespace tessera
