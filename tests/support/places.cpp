#include "tests/support/places.h"

namespace mis {

std::filesystem::path source_dir() { return MIS_SOURCE_DIR; }
std::filesystem::path program_file() { return MIS_PROGRAM_FILE; }

}  // namespace mis
