#pragma once

#include "mis/io/byte_source.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mis {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t lines = 0;  ///< of the header itself
    char line_end = '\n';   ///< '\r' in the files of old Macs
};

/// Reads the header of a PLY file; the source then stands at its body. Throws SceneError unless it
/// is well-formed, its counts can be those of a file of this size, and each name stands once.
/// Source: Greg Turk, "The PLY Polygon File Format", 1994.
PlyHeader read_ply_header(ByteSource& source, const std::filesystem::path& file);

}  // namespace mis
