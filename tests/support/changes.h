#pragma once

#include "mis/changes/changes.h"
#include "mis/words/changes_remarks.h"

namespace mis {

/// What changed between two reports, with the remarks on them, as `compare OLD NEW` finds it.
inline Changes remarked_changes(const Report& before, const Report& after,
                                const ChangesOptions& options = {})
{
    Changes changes = changes_between(before, after, options);
    add_remarks(changes, before, after);
    return changes;
}

}  // namespace mis
