# cmake --install: the program, the libraries, and find_package(mis COMPONENTS core c embree tbb compare io).
# --component development installs the libraries, without the program.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/mis")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/mis" "${PROJECT_BINARY_DIR}/generated/mis"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h" PATTERN cli EXCLUDE)

# One file of targets per component, so that one that is not asked for asks for nothing.
set(components "")
foreach(component core c embree tbb compare io)
  if(TARGET mis_${component})
    list(APPEND components ${component})
    install(TARGETS mis_${component} EXPORT mis-${component} ARCHIVE)
    if(component STREQUAL core)
      set_target_properties(mis_headers PROPERTIES EXPORT_NAME headers)
      install(TARGETS mis_headers EXPORT mis-core)
    endif()
    install(EXPORT mis-${component} NAMESPACE mis:: DESTINATION "${package_dir}")
  endif()
endforeach()

configure_package_config_file(cmake/mis-config.cmake.in "${PROJECT_BINARY_DIR}/mis-config.cmake"
  INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/mis-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/mis-config.cmake" "${PROJECT_BINARY_DIR}/mis-config-version.cmake"
  cmake/FindOpenImageIO.cmake DESTINATION "${package_dir}")

# For hosts that CMake does not build. The prefix is where the file lies, wherever that is moved to.
set(pc_flags "")
if(NOT MIS_XSIMD_INCLUDE_DIR)
  set(pc_flags " -DMIS_WITHOUT_LANES")
endif()
file(RELATIVE_PATH pc_up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(cmake/mis-core.pc.in "${PROJECT_BINARY_DIR}/mis-core.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/mis-core.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

if(TARGET mis_images)
  install(TARGETS mis_images LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/mis" COMPONENT program)
endif()
if(TARGET mis_program)
  install(TARGETS mis_program RUNTIME COMPONENT program)
  install(DIRECTORY scenes/ DESTINATION "${CMAKE_INSTALL_DATADIR}/mis/scenes" COMPONENT program)
endif()
if(TARGET mis_python)
  set(packages lib/python3/dist-packages) # where Debian's Python looks below /usr; elsewhere, PYTHONPATH names it
  install(TARGETS mis_python LIBRARY DESTINATION "${packages}" COMPONENT python)
  install(FILES mis/bind/python/mis.pyi DESTINATION "${packages}" COMPONENT python)
endif()
install(FILES LICENSE README.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
