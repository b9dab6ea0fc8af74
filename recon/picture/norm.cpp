#include "recon/picture/norm.h"

namespace tessera {

std::string_view to_string(Norm norm) {
    switch (norm) {
    case Norm::none:
        return "none";
    case Norm::l2:
        return "l2";
    case Norm::l1:
        return "l1";
    case Norm::mixed:
        return "mixed";
    case Norm::uniform:
        return "uniform";
    case Norm::weighted:
        return "weighted";
    case Norm::guided:
        return "guided";
    case Norm::smoothed:
        return "smoothed";
    case Norm::oidn:
        return "oidn";
    }
    return "?";
}

std::string_view to_string(Spikes spikes) {
    return spikes == Spikes::off ? "off" : "consistent";
}

bool expands(Norm norm) {
    return norm == Norm::l2 || norm == Norm::l1 || norm == Norm::mixed || norm == Norm::weighted;
}

bool is_linear(Norm norm) {
    return norm == Norm::none || norm == Norm::l2 || norm == Norm::uniform;
}

} // namespace tessera
