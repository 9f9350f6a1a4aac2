#include "mis/study/schedule.h"

#include "mis/sampling/random.h"

#include <numeric>

namespace mis {

std::vector<std::size_t> round_order(std::size_t n, std::uint64_t seed, std::uint32_t round)
{
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) {  // Fisher and Yates
        const Words words = random_words(~seed, {round, i, 0}, Block::light);
        std::swap(order[i - 1], order[choice_bits(words) % i]);
    }
    return order;
}

}  // namespace mis
