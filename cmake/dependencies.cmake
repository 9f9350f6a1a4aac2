# What is there decides which libraries are built; the program and the tests need all of them, a bare core only GLM.
if(MIS_PROGRAM OR MIS_TESTS OR MIS_BENCH OR MIS_FUZZ)
  set(need REQUIRED)
  set(need_file REQUIRED)
else()
  set(need QUIET)
  set(need_file "")
endif()

find_package(glm REQUIRED)
# Lanes; without xsimd all kernels are scalar. Its package file asks for xtl, which its headers do not use here.
find_path(MIS_XSIMD_INCLUDE_DIR xsimd/xsimd.hpp)
mark_as_advanced(MIS_XSIMD_INCLUDE_DIR)

find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 ${need})
endif()
find_package(TBB ${need})
find_package(Boost 1.74 ${need})  # headers alone: Boost.Math
find_package(fmt ${need})
find_package(nlohmann_json ${need})
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
find_package(OpenImageIO MODULE ${need})
# Plots of the report: one file that the build embeds.
find_file(MIS_D3_FILE d3.min.js PATHS /usr/share/nodejs/d3/dist PATH_SUFFIXES nodejs/d3/dist ${need_file})
mark_as_advanced(MIS_D3_FILE)
if(TARGET Boost::headers AND fmt_FOUND AND nlohmann_json_FOUND AND OpenImageIO_FOUND AND MIS_D3_FILE)
  set(MIS_HAS_IO ON)
endif()

if(MIS_PROGRAM)
  find_package(CLI11 REQUIRED)
endif()
if(MIS_TESTS)
  find_package(GTest REQUIRED)
endif()
if(MIS_BENCH)
  find_package(benchmark REQUIRED)
endif()

# The Python module, where Python's headers, NumPy and pybind11 are there. Debian's Python before any other: pybind11 and
# NumPy are its packages.
if(MIS_PYTHON AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
  set(MIS_PYTHON OFF)  # a sanitizer's runtime is not Python's
elseif(MIS_PYTHON)
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module NumPy QUIET)
  find_package(pybind11 2.9 CONFIG QUIET)
  if(NOT Python_FOUND OR NOT pybind11_FOUND)
    message(STATUS "no Python module: it needs pybind11, Python's headers and NumPy (packages.txt)")
    set(MIS_PYTHON OFF)
  endif()
endif()
