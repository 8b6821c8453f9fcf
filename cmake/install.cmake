# What `cmake --install` puts where. Component `program`: what it takes to run skinfit. Component `development`: what it
# takes to build other programs with its libraries. Component `plain`: what a Debian package has in a form of its own.
include(CMakePackageConfigHelpers)

set(doc_folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/skinfit)
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/skinfit COMPONENT program
  PATTERN *_results EXCLUDE
  PATTERN *.sh EXCLUDE)
install(PROGRAMS configs/slurm_study.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/skinfit/configs COMPONENT program)
install(DIRECTORY measurements/data DESTINATION ${CMAKE_INSTALL_DATADIR}/skinfit/measurements COMPONENT program)
install(FILES README.md CITATION.cff DESTINATION ${doc_folder} COMPONENT program)
install(FILES CHANGELOG.md LICENSE DESTINATION ${doc_folder} COMPONENT plain)
install(FILES model/REFERENCES.md DESTINATION ${doc_folder}/model COMPONENT program)
install(DIRECTORY docs DESTINATION ${doc_folder} COMPONENT program)

# The form of Debian's copyright files: the text is indented, and an empty line is a full stop.
file(READ LICENSE licence)
string(REGEX REPLACE "^.*\n\n(Permission is)" "\\1" licence "${licence}")
string(STRIP "${licence}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
configure_file(cmake/package/copyright.in copyright @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS LICENSE)
install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION ${doc_folder} COMPONENT program)

foreach(name IN ITEMS core model transport measurements fit report)
  set_target_properties(skinfit_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS skinfit_${name} EXPORT skinfitTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/skinfit)
  install(DIRECTORY ${name} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/skinfit COMPONENT development
    FILES_MATCHING PATTERN *.hpp
    PATTERN data EXCLUDE
    PATTERN vector_scattering.hpp EXCLUDE)  # compiled anew for each instruction set, by its one user
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/core/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/skinfit/core COMPONENT development)
set_target_properties(skinfit_options PROPERTIES EXPORT_NAME options)
install(TARGETS skinfit_options EXPORT skinfitTargets)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/skinfit)
install(EXPORT skinfitTargets NAMESPACE skinfit:: DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(cmake/skinfitConfig.cmake.in skinfitConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(skinfitConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/skinfitConfig.cmake
    ${PROJECT_BINARY_DIR}/skinfitConfigVersion.cmake
    cmake/FindRandom123.cmake
  DESTINATION ${package_folder} COMPONENT development)
