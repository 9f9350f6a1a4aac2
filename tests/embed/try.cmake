# Builds and runs strangers' projects: against mis as it is installed (find_package, pkg-config), and with mis inside
# (add_subdirectory, FetchContent), there as a bare core: without lanes, exceptions and RTTI.
set(work "${build}/embed")
file(REMOVE_RECURSE "${work}")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The program that docs/embedding.md shows is the one that is built.
file(READ "${source}/../../docs/embedding.md" text)
string(REGEX MATCH "\n```cpp\n(.*\n)```\n\n`sample_direct`" found "${text}")
if(NOT found)
  message(FATAL_ERROR "docs/embedding.md shows no program")
endif()
set(walkthrough "${work}/walkthrough.cpp")
file(CONFIGURE OUTPUT "${walkthrough}" CONTENT [[@CMAKE_MATCH_1@]] @ONLY)

function(build_and_run project how flags) # …: more for CMake
  run("${CMAKE_COMMAND}" -S "${source}/${project}" -B "${work}/${how}" -G "${generator}" "-DWALKTHROUGH=${walkthrough}"
    "-DCMAKE_BUILD_TYPE=${build_type}" "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${launcher}"
    "-DCMAKE_CXX_FLAGS=${flags}" ${ARGN})
  run("${CMAKE_COMMAND}" --build "${work}/${how}" --target walkthrough)
  run("${work}/${how}/walkthrough")
endfunction()

run("${CMAKE_COMMAND}" --install "${build}" --component development --prefix "${work}/prefix")
build_and_run(installed installed "${flags}" "-DCMAKE_PREFIX_PATH=${work}/prefix")
run("${CMAKE_COMMAND}" --build "${work}/installed" --target stranger)
run("${work}/installed/stranger")
run("${CMAKE_COMMAND}" --build "${work}/installed" --target host_in_c)
run("${work}/installed/host_in_c")

# A renderer of its own, before and after it gained mis (tests/host compares its pictures).
run("${CMAKE_COMMAND}" -S "${source}/host" -B "${work}/host" -G "${generator}" "-DCMAKE_BUILD_TYPE=${build_type}"
  "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${launcher}" "-DCMAKE_CXX_FLAGS=${flags}"
  "-DCMAKE_PREFIX_PATH=${work}/prefix")
run("${CMAKE_COMMAND}" --build "${work}/host")
foreach(host before after)
  run("${work}/host/host_${host}" "${source}/host/room.scene" "${work}/${host}.pfm" 4)
endforeach()

find_program(pkg_config pkg-config)
if(pkg_config)
  set(ENV{PKG_CONFIG_PATH} "${work}/prefix/${libdir}/pkgconfig")
  execute_process(COMMAND "${pkg_config}" --cflags --libs mis-core OUTPUT_VARIABLE options COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(options UNIX_COMMAND "${options} ${flags}")
  run("${compiler}" -std=c++20 "${walkthrough}" ${options} -o "${work}/by_pkg_config")
  run("${work}/by_pkg_config")
endif()

set(bare "-DMIS_SOURCE=${source}/../.." -DMIS_XSIMD_INCLUDE_DIR=OFF)
set(build_type Debug) # it compiles sooner
build_and_run(inside inside "${flags} -fno-exceptions -fno-rtti" ${bare})
build_and_run(inside inside "${flags} -fno-exceptions -fno-rtti" ${bare} -DFETCH=ON)
