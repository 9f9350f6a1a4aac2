# The kernels (mis/engine/kernels*.cpp) are compiled once per instruction set, with MIS_ISA=<name>; the engine picks one at
# run time by what the processor can do. All else is compiled for the baseline, so the binary runs on any x86-64.
include(CheckCXXCompilerFlag)

set(MIS_INSTRUCTION_SETS scalar)
set(MIS_FLAGS_scalar "")
if(MIS_XSIMD_INCLUDE_DIR)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    list(APPEND MIS_INSTRUCTION_SETS avx2 avx512)
    set(MIS_FLAGS_avx2 -mavx2 -mfma)
    set(MIS_FLAGS_avx512 -mavx512f -mavx512bw -mavx512dq -mavx512cd -mavx2 -mfma)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
      list(APPEND MIS_FLAGS_avx512 -Wno-maybe-uninitialized)  # false alarms in GCC 12's own intrinsics (its bug 105593)
    endif()
    check_cxx_compiler_flag(-mprefer-vector-width=512 MIS_HAS_PREFER_VECTOR_WIDTH)
    if(MIS_HAS_PREFER_VECTOR_WIDTH)
      list(APPEND MIS_FLAGS_avx512 -mprefer-vector-width=512)
    endif()
    # GCC 12 takes the undefined vectors inside its own AVX-512 header for mistakes (GCC bug 105593).
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
      list(APPEND MIS_FLAGS_avx512 -Wno-uninitialized -Wno-maybe-uninitialized)
    endif()
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    list(APPEND MIS_INSTRUCTION_SETS neon64)
    set(MIS_FLAGS_neon64 "")
  endif()
endif()

# Adds the sources to `target` once per instruction set, and tells `target` which there are (MIS_HAS_AVX2=1 …).
function(mis_add_kernels target)
  foreach(isa IN LISTS MIS_INSTRUCTION_SETS)
    string(TOUPPER ${isa} upper)
    target_compile_definitions(${target} PRIVATE MIS_HAS_${upper}=1)
    if(ARGN)
      add_library(mis_kernels_${isa} OBJECT ${ARGN})
      target_link_libraries(mis_kernels_${isa} PRIVATE mis_headers)
      set_target_properties(mis_kernels_${isa} PROPERTIES POSITION_INDEPENDENT_CODE ON)  # for the Python module
      # xsimd's own scalar helpers carry no name of the instruction set that they are compiled for: they get one.
      target_compile_definitions(mis_kernels_${isa} PRIVATE MIS_ISA=${isa}
        __ieee754_rem_pio2=__ieee754_rem_pio2_${isa} __kernel_rem_pio2=__kernel_rem_pio2_${isa})
      target_compile_options(mis_kernels_${isa} PRIVATE ${MIS_KERNEL_FLAGS} ${MIS_FLAGS_${isa}})
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:mis_kernels_${isa}>)
    endif()
  endforeach()
endfunction()
