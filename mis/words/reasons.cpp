#include "mis/words/reasons.h"

#include "mis/words/numbers.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

const char* variance_words(bool is_relative)
{
    return is_relative ? "relative variance" : "variance";
}

/// "4096 samples", or "256 scramblings".
std::string words_of(const reason::Observations& of)
{
    return counted(of.count, of.are_scramblings ? "scrambling" : "sample");
}

std::string words_of(const reason::None&) { return ""; }

std::string words_of(const reason::AsWritten& why) { return why.text; }

std::string words_of(const reason::Stopped&) { return "stopped before its turn"; }

std::string words_of(const reason::PastBudget& why)
{
    return "past the budget: the first " + counted(why.samples, "sample") +
           " of it and of those that cost less would take more than " + percent(why.share) +
           " of the time given";
}

std::string words_of(const reason::NotReady&)
{
    return "past the budget: its tables and its first samples were not ready in the time given";
}

std::string words_of(const reason::LateSetUp&)
{
    return "past the budget: the set-up, the audit included, left too little of the time given";
}

std::string words_of(const reason::AuditFails& why)
{
    return std::string("the other strategies' samples find a ") + variance_words(why.relative) +
           " of at least " + number(why.at_least, 2) + " where its own saw " + number(why.own, 2) +
           ": it has not drawn the rare samples that matter";
}

std::string words_of(const reason::NeverVaries& why)
{
    return "all of its " + words_of(why.of) +
           " say the same, which proves nothing: rare samples may not have been drawn yet";
}

std::string words_of(const reason::FewReplicates&)
{
    return "its error takes at least two replicates";
}

std::string words_of(const reason::NotFinite&) { return "its variance is not a finite number"; }

std::string words_of(const reason::RoundingAlone& why)
{
    const std::string found = "its samples differ by the rounding of floats alone, ";
    if (why.zero_points > 0)
        return found + "but at " + many(why.zero_points, "point") +
               " all of them are 0, which proves nothing: rare samples may not have been drawn yet";
    return found + "which shows no variance and does not prove that there is none";
}

std::string words_of(const reason::CarriedByFew& why)
{
    const std::string more =
        why.carried_by > 0 ? ", about " + number(std::max(1.1, why.needed / why.carried_by), 2) +
                                 " times as many samples as now"
                           : "";
    return std::string("its ") + variance_words(why.relative) + " is carried by about " +
           count(why.carried_by) + " of " + words_of(why.of) + "; " + count(why.needed) +
           " are needed" + more;
}

std::string words_of(const reason::ReplicatesDiffer& why)
{
    return "its variance differs too much from replicate to replicate (its standard error is " +
           (std::isnan(why.error) ? "unknown" : percent(why.error)) + "; at most " +
           percent(why.largest) + " is trusted)";
}

std::string words_of(const reason::BelowErrors& why)
{
    return std::string("its ") + variance_words(why.relative) + " is below " + count(why.errors) +
           " of its standard errors, so that only a bound of it is known";
}

std::string words_of(const reason::NeverDraws& why)
{
    return "it never draws directions that carry " + percent(why.share) + " of the light";
}

std::string words_of(const reason::MeanDiffers& why)
{
    const std::string where = why.region < 0 ? ""
                                             : " in region " + std::to_string(why.region) + " of " +
                                                   std::to_string(why.regions);
    return "its mean" + where + " is " +
           (why.reference != 0 ? percent(std::fabs(why.difference / why.reference))
                               : number(std::fabs(why.difference))) +
           (why.difference > 0 ? " above" : " below") +
           (why.beside_shared ? " that of the shared directions" : " what the others agree on") +
           " (p = " + number(why.p_value, 1) + ", corrected)" +
           (why.are_only_two ? "; only two are left, and nothing says which of them is right"
                             : "") +
           (why.may_lack_rare_samples ? ": it is biased, or lacks rare samples there" : "");
}

std::string words_of(const reason::FirstDoublingLate&)
{
    return "past the budget: the first doubling was not done in time";
}

std::string words_of(const reason::DoublingsTooDear& why)
{
    return "past the budget: about " + duration(why.seconds) +
           " of CPU time for the first three doublings";
}

std::string words_of(const reason::NoFirstLook&)
{
    return "past the budget: there was no time for a first sample";
}

std::string words_of(const reason::SampleTooDear& why)
{
    return "past the budget: one sample per point takes " + duration(why.seconds) + ", " +
           many(static_cast<std::size_t>(why.times), "time");
}

std::string words_of(const reason::NoTimeLeft&)
{
    return "past the budget: no time is left for another curve";
}

std::string words_of(const reason::NothingLit&)
{
    return "no point can be lit: every estimate is 0";
}

}  // namespace

std::string reason_words(const Reason& why)
{
    return std::visit([](const auto& each) { return words_of(each); }, why);
}

std::string reason_words(const CostReason& why)
{
    return std::visit([](const auto& each) { return words_of(each); }, why);
}

}  // namespace mis
