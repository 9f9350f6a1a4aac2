#pragma once

#include "mis/report/scene_facts.h"
#include "mis/study/study_points.h"

namespace mis {

/// What a report says of a scene and of the points that its figures are over.
SceneFacts facts_of(const Scene& scene, const StudyPoints& points);

}  // namespace mis
