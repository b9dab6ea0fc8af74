# Installation and packages. Components: the program, and the library `recon` for other programs (component `recon`).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS tessera RUNTIME COMPONENT program)
install(FILES assets/desktop/tessera.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
install(FILES assets/desktop/tessera.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT program)
install(FILES assets/desktop/tessera.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo
  RENAME io.github.tessera.tessera.metainfo.xml COMPONENT program)
install(FILES assets/desktop/tessera.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME tessera COMPONENT program)
install(FILES docs/tessera.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES LICENSE NOTICE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# The public headers of recon. Their includes stay "recon/...".
foreach(header image.h norm.h enumeration.h parallel.h parameters.h solvers/poisson_problem.h picture/reconstruct.h)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES recon/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tessera/recon/${folder} COMPONENT recon)
endforeach()
install(TARGETS recon ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT recon)
configure_package_config_file(cmake/TesseraConfig.cmake.in ${PROJECT_BINARY_DIR}/TesseraConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Tessera PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TesseraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TesseraConfig.cmake ${PROJECT_BINARY_DIR}/TesseraConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Tessera COMPONENT recon)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tessera)
set(CPACK_PACKAGE_VENDOR "The Tessera authors")
set(CPACK_PACKAGE_CONTACT "The Tessera authors <tessera@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Explore light transport by path reuse")
set(CPACK_PACKAGE_DESCRIPTION
  "Path tracing, path reusing, gradient-domain path tracing and gradient-domain
path reusing side by side on real scenes, with tiles, gradients,
reconstructions and errors on display. The same program renders, compares and
measures without a window.")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program recon)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME tessera)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# GLFW loads OpenGL at run time, and the viewer reads its fonts from the system.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libgl1, fonts-inter, fonts-jetbrains-mono, fonts-font-awesome")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libgl1-mesa-dri")
set(CPACK_DEBIAN_RECON_PACKAGE_NAME libtessera-recon-dev)
set(CPACK_DEBIAN_RECON_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_RECON_PACKAGE_DEPENDS "libglm-dev")
set(CPACK_COMPONENT_RECON_DESCRIPTION "Reconstruction library of Tessera: pictures from primal, gradients and features.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
include(CPack)
