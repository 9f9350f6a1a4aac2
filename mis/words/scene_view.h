#pragma once

#include "mis/report/report.h"

#include <string>
#include <utility>
#include <vector>

namespace mis {

/// What sentences about a scene ask its report. Strategies are indices of SceneReport::strategies.
class SceneView {
public:
    explicit SceneView(const SceneReport& scene) : scene_(scene) {}

    const SceneReport& scene() const { return scene_; }
    int count() const { return static_cast<int>(scene_.strategies.size()); }
    const StrategyReport& of(int i) const { return scene_.strategies[static_cast<std::size_t>(i)]; }
    std::string name(int i) const { return name_of(of(i).strategy); }

    /// The pair of i and j, in either order; null where they are not compared.
    const PairReport* pair(int i, int j) const;

    /// How many times sooner i reaches 1 % than j.
    Interval sooner(int i, int j) const;

    /// Wall seconds to 1 %; infinite where it is not ranked or not known.
    double seconds(int i) const;
    bool is_timed(int i) const;

    /// Of that name; −1 where there is none.
    int find(const std::string& name) const;

    /// The strategy to use: what the report says, or in older ones the first in order. −1: none.
    int leader() const;

    /// Ranked strategies from the soonest to the last, without times by variance.
    std::vector<int> in_order() const;

private:
    const SceneReport& scene_;
};

/// b over a of a over b.
Interval turned_over(const Interval& ratio);

/// Sentences so far, each without its full stop.
class Sentences {
public:
    void say(const std::string& sentence) { said_.push_back(sentence + "."); }
    std::vector<std::string> all() && { return std::move(said_); }

private:
    std::vector<std::string> said_;
};

}  // namespace mis
