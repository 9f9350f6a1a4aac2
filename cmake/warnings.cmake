# Flags of everything below this directory; an embedder's own targets stay as they are.
# Contraction off: a*b + c rounds the same on every machine, so the same seed gives the same bits.
add_compile_options(
  -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion
  -ffp-contract=off)
# Designated initialisers name what differs from the defaults; the rest is left out on purpose.
add_compile_options(-Wno-missing-field-initializers)
# GCC 12 sees overlapping and endless copies inside std::string where there are none (GCC bugs 105651, 105329).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()
# Several sources in one (MIS_UNITY): what GCC takes for headers are sources.
if(MIS_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wno-subobject-linkage)
endif()
if(MIS_WERROR)
  add_compile_options(-Werror)
endif()
