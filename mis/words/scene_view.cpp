#include "mis/words/scene_view.h"

#include "mis/math/limits.h"

#include <algorithm>
#include <cmath>

namespace mis {

const PairReport* SceneView::pair(int i, int j) const
{
    for (const PairReport& p : scene_.pairs)
        if ((p.a == i && p.b == j) || (p.a == j && p.b == i)) return &p;
    return nullptr;
}

Interval SceneView::sooner(int i, int j) const
{
    const PairReport* p = pair(i, j);
    if (!p) return {1, 1, 1};
    return p->b == i ? p->time_ratio : turned_over(p->time_ratio);
}

double SceneView::seconds(int i) const
{
    const double seconds = of(i).seconds_to_1_percent.value;
    return of(i).status == Status::ranked && !std::isnan(seconds) ? seconds : infinity;
}

bool SceneView::is_timed(int i) const { return std::isfinite(seconds(i)); }

std::vector<int> SceneView::in_order() const
{
    std::vector<int> order;
    for (int i = 0; i < count(); ++i)
        if (of(i).status == Status::ranked) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return std::pair(seconds(a), of(a).rank) < std::pair(seconds(b), of(b).rank);
    });
    return order;
}

int SceneView::find(const std::string& name) const
{
    for (int i = 0; i < count(); ++i)
        if (this->name(i) == name) return i;
    return -1;
}

int SceneView::leader() const
{
    const int named = find(scene_.leader);
    if (named >= 0 && of(named).status == Status::ranked) return named;
    const std::vector<int> order = in_order();
    return order.empty() ? -1 : order.front();
}

Interval turned_over(const Interval& ratio)
{
    return {1 / ratio.value, 1 / ratio.high, 1 / ratio.low};
}

}  // namespace mis
