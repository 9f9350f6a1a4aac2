# The registries: a folder of choices (policy, technique, heuristic, bsdf) lists them in its CMakeLists.txt, one line each,
#     mis_policy(power PowerPolicy)      # the type PowerPolicy, in mis/policy/power.h
# and from the lines of a folder comes <build>/generated/mis/<folder>/registry.h with the list of their types.

function(mis_choice room file type)
  if(NOT EXISTS "${PROJECT_SOURCE_DIR}/mis/${room}/${file}.h")
    message(FATAL_ERROR "mis/${room}/CMakeLists.txt lists ${type}, but mis/${room}/${file}.h does not exist")
  endif()
  set_property(GLOBAL APPEND_STRING PROPERTY mis_${room}_includes "#include \"mis/${room}/${file}.h\"\n")
  set_property(GLOBAL APPEND PROPERTY mis_${room}_types ${type})
endfunction()

function(mis_registry room list)
  add_subdirectory("${PROJECT_SOURCE_DIR}/mis/${room}" "${PROJECT_BINARY_DIR}/mis/${room}")
  get_property(includes GLOBAL PROPERTY mis_${room}_includes)
  get_property(types GLOBAL PROPERTY mis_${room}_types)
  list(JOIN types ", " types)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/mis/${room}/registry.h" @ONLY CONTENT
"#pragma once
// Made from mis/@room@/CMakeLists.txt.
@includes@#include \"mis/math/type_list.h\"

namespace mis {
using @list@ = TypeList<@types@>;
}
")
endfunction()

macro(mis_policy file type)
  mis_choice(policy ${file} ${type})
endmacro()
macro(mis_technique file type)
  mis_choice(technique ${file} ${type})
endmacro()
macro(mis_heuristic file type)
  mis_choice(heuristic ${file} ${type})
endmacro()
macro(mis_bsdf file type)
  mis_choice(bsdf ${file} ${type})
endmacro()
