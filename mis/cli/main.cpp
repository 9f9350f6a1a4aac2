#include "mis/cli/command_line.h"
#include "mis/cli/options.h"
#include "mis/io/scene_error.h"
#include "mis/strategy/strategy.h"

#include <fmt/format.h>

#include <new>

namespace {

using namespace mis::cli;  // NOLINT: the program's own names

int complain(const char* message, int code)
{
    fmt::print(stderr, "mis: {}\n", message);
    return code;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        return run_command_line(argc, argv);
    } catch (const UsageError& error) {
        return complain(error.what(), usage);
    } catch (const mis::StrategyError& error) {
        return complain(error.what(), usage);
    } catch (const mis::SceneError& error) {
        return complain(error.what(), usage);
    } catch (const std::bad_alloc&) {
        return complain("out of memory", failed);
    } catch (const std::exception& error) {
        return complain(error.what(), failed);
    }
}
