#include "mis/cli/command_line.h"
#include "mis/cli/interrupt.h"
#include "mis/cli/options.h"
#include "mis/cli/remark.h"
#include "mis/io/scene_error.h"
#include "mis/math/stop_token.h"
#include "mis/strategy/strategy.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <new>
#include <string>
#include <system_error>

namespace {

using namespace mis::cli;  // NOLINT: the program's own names

int complain(const char* message, int code)
{
    remark("mis: {}\n", message);
    return code;
}

/// The exit code, given that of the command: what waits for standard output is written now, and
/// what was not written is no success.
int with_all_output_written(int code)
{
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    const std::string why = errno != 0 ? ": " + std::generic_category().message(errno) : "";
    return complain(("standard output: cannot be written" + why).c_str(), failed);
}

}  // namespace

int main(int argc, char** argv)
{
    watch_for_interrupt();
    try {
        return with_all_output_written(run_command_line(argc, argv));
    } catch (const UsageError& error) {
        return complain(error.what(), usage);
    } catch (const mis::StrategyError& error) {
        return complain(error.what(), usage);
    } catch (const mis::SceneError& error) {
        return complain(error.what(), usage);
    } catch (const mis::Stopped&) {
        return complain("interrupted before there was a result; nothing was written", interrupted);
    } catch (const std::bad_alloc&) {
        return complain("out of memory", failed);
    } catch (const std::exception& error) {
        return complain(error.what(), failed);
    }
}
