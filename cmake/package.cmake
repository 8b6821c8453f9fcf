# The Debian package of the program: `cpack -G DEB` in the build folder. The preset `package` is the build to make it of.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME skinfit)
set(CPACK_PACKAGE_CONTACT "skinfit developers")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package/open_folders.cmake)
set(CPACK_COMPONENTS_ALL program debian)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "\
skinfit fits the BioSpec model of light in human skin to measured spectra of
reflectance or transmittance. It finds the melanosome fraction, the blood
fractions, the oxygen saturation and the bilirubin that explain a spectrum,
says how sure it is, and says so when the spectrum cannot tell. It reads
single spectra, tables of them and hyperspectral images.

It is research software, not a medical device.")

# Plots are drawn by gnuplot, and cubes are read by GDAL: both are looked for when they are needed, so that no tool sees
# that the program uses them. The package of a library has the name of its file: libgdal.so.32 is in libgdal32.
set(recommended gnuplot-nox)
get_target_property(gdal_configurations GDAL::GDAL IMPORTED_CONFIGURATIONS)
list(GET gdal_configurations 0 gdal_configuration)
get_target_property(gdal_soname GDAL::GDAL IMPORTED_SONAME_${gdal_configuration})
if(gdal_soname MATCHES "^libgdal\\.so\\.([0-9]+)$")
  list(APPEND recommended libgdal${CMAKE_MATCH_1})
endif()
list(JOIN recommended ", " CPACK_DEBIAN_PACKAGE_RECOMMENDS)

# Two changelogs, by Debian's names: that of the project, and that of its package.
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/package/changelog.Debian.in changelog.Debian @ONLY)
configure_file(CHANGELOG.md changelog COPYONLY)
find_program(GZIP_PROGRAM gzip)
mark_as_advanced(GZIP_PROGRAM)
if(GZIP_PROGRAM)
  execute_process(COMMAND ${GZIP_PROGRAM} --force --best --no-name --keep changelog changelog.Debian
    WORKING_DIRECTORY ${PROJECT_BINARY_DIR} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz ${PROJECT_BINARY_DIR}/changelog.Debian.gz
    DESTINATION ${doc_folder} COMPONENT debian EXCLUDE_FROM_ALL)
endif()

include(CPack)
