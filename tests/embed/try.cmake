# Builds and runs strangers' projects: against mis as it is installed (find_package, pkg-config), and with mis inside
# (add_subdirectory, FetchContent), there as a bare core: without lanes, exceptions and RTTI.
set(work "${build}/embed")
file(REMOVE_RECURSE "${work}")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The programs that docs/embedding.md shows are those that are built.
file(READ "${source}/../../docs/embedding.md" text)
function(extract file after) # the program that stands before the words `after`
  string(FIND "${text}" "\n```\n\n`${after}`" end)
  string(SUBSTRING "${text}" 0 ${end} program)
  string(FIND "${program}" "\n```cpp\n" begin REVERSE)
  if(end LESS 0 OR begin LESS 0)
    message(FATAL_ERROR "docs/embedding.md shows no program before ${after}")
  endif()
  math(EXPR begin "${begin} + 8")
  string(SUBSTRING "${program}" ${begin} -1 program)
  file(CONFIGURE OUTPUT "${file}" CONTENT "@program@\n" @ONLY)
endfunction()
set(walkthrough "${work}/walkthrough.cpp")
set(many_points "${work}/many_points.cpp")
extract("${walkthrough}" sample_direct)
extract("${many_points}" PointLighter)

function(build_and_run project how flags) # …: more for CMake
  run("${CMAKE_COMMAND}" -S "${source}/${project}" -B "${work}/${how}" -G "${generator}" "-DWALKTHROUGH=${walkthrough}"
    "-DCMAKE_BUILD_TYPE=${build_type}" "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${launcher}"
    "-DCMAKE_CXX_FLAGS=${flags}" ${ARGN})
  run("${CMAKE_COMMAND}" --build "${work}/${how}" --target walkthrough)
  run("${work}/${how}/walkthrough")
endfunction()

run("${CMAKE_COMMAND}" --install "${build}" --component development --prefix "${work}/prefix")
build_and_run(installed installed "${flags}" "-DCMAKE_PREFIX_PATH=${work}/prefix" "-DMANY_POINTS=${many_points}")
foreach(host stranger many_points host_in_c)
  run("${CMAKE_COMMAND}" --build "${work}/installed" --target ${host})
  run("${work}/installed/${host}")
endforeach()

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
