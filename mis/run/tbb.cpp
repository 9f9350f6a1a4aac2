#include "mis/run/tbb.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace mis {

struct TbbExecutor::Arena {
    explicit Arena(int threads)
        : at_most(
              tbb::global_control::max_allowed_parallelism,
              static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency())),
          arena(threads > 0 ? threads : tbb::task_arena::automatic)
    {
        arena.initialize();
    }
    tbb::global_control
        at_most;  // so that more threads than cores can be had, and no more than asked for
    tbb::task_arena arena;
};

TbbExecutor::TbbExecutor(int threads) : arena_(std::make_shared<Arena>(threads)) {}

int TbbExecutor::threads() const { return arena_->arena.max_concurrency(); }

void TbbExecutor::for_each(std::size_t n, const std::function<void(std::size_t)>& body) const
{
    arena_->arena.execute([&] {
        tbb::parallel_for(
            std::size_t{0}, n, [&](std::size_t i) { body(i); }, tbb::simple_partitioner{});
    });
}

}  // namespace mis
