#pragma once

#include <cstddef>
#include <string>
#include <variant>

namespace mis {

/// What was found where a strategy is not ranked, as numbers; words/reasons.h says it.
namespace reason {

/// It is ranked, or nothing is known.
struct None {};

/// A report that was read says so, in words.
struct AsWritten {
    std::string text;
};

/// The run was stopped before its turn.
struct Stopped {};

/// So many samples of it, and of all that cost less, would take more than this share of the time.
struct PastBudget {
    double samples = 0, share = 0;
};

/// Its tables and its first samples were not ready in the time given.
struct NotReady {};

/// The set-up, the audit included, left too little of the time.
struct LateSetUp {};

/// How many samples there were of each point, or scramblings.
struct Observations {
    double count = 0;
    bool are_scramblings = false;
};

/// The other strategies' samples find a larger variance than its own: at least so much.
struct AuditFails {
    bool relative = false;  ///< of the relative variance
    double at_least = 0, own = 0;
};

/// All of its samples are equal, which proves nothing.
struct NeverVaries {
    Observations of;
};

/// There are fewer than two replicates, so no error is known.
struct FewReplicates {};

/// Its mean or variance is infinite or NaN.
struct NotFinite {};

/// Fewer samples carry the variance than are needed.
struct CarriedByFew {
    bool relative = false;  ///< the relative variance
    double carried_by = 0, needed = 0;
    Observations of;
};

/// Its samples differ by the rounding of floats alone, which is no proof that it is exact.
struct RoundingAlone {
    std::size_t zero_points = 0;  ///< where all of its samples are 0
};

/// The variance has a larger relative standard error than is trusted; NaN: unknown.
struct ReplicatesDiffer {
    double error = 0, largest = 0;
};

/// Shared directions find no variance that is above so many of its standard errors: it is bounded.
struct BelowErrors {
    bool relative = false;  ///< the relative variance
    double errors = 3;
};

/// It never draws directions that carry this share of the light.
struct NeverDraws {
    double share = 0;
};

/// Its mean is not the others'.
struct MeanDiffers {
    int region = -1;  ///< −1: over the whole image
    std::size_t regions = 0;
    double difference = 0, reference = 0;
    double p_value = 1;  ///< corrected
    bool are_only_two = false;
    bool may_lack_rare_samples = false;
    bool beside_shared = false;  ///< the reference is that of shared directions, not of the others
};

// Of a curve of `mis cost` that has no points.

/// Its first doubling was not done in time.
struct FirstDoublingLate {};

/// Its first three doublings would take so many CPU seconds.
struct DoublingsTooDear {
    double seconds = 0;
};

/// There was no time for a first sample.
struct NoFirstLook {};

/// One sample of every point takes so many seconds, so many times.
struct SampleTooDear {
    double seconds = 0;
    int times = 0;
};

/// No time was left for another curve.
struct NoTimeLeft {};

/// No point can be lit: every estimate is 0.
struct NothingLit {};

}  // namespace reason

using Reason = std::variant<reason::None, reason::AsWritten, reason::Stopped, reason::PastBudget,
                            reason::NotReady, reason::LateSetUp, reason::AuditFails,
                            reason::NeverVaries, reason::FewReplicates, reason::NotFinite,
                            reason::RoundingAlone, reason::CarriedByFew, reason::ReplicatesDiffer,
                            reason::BelowErrors, reason::NeverDraws, reason::MeanDiffers>;

using CostReason = std::variant<reason::None, reason::Stopped, reason::FirstDoublingLate,
                                reason::DoublingsTooDear, reason::NoFirstLook,
                                reason::SampleTooDear, reason::NoTimeLeft, reason::NothingLit>;

inline bool is_none(const Reason& why) { return std::holds_alternative<reason::None>(why); }
inline bool is_none(const CostReason& why) { return std::holds_alternative<reason::None>(why); }

}  // namespace mis
