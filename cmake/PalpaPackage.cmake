# The Debian package: cmake/package.sh, or target `package` of a release build. What it needs to run
# is found by dpkg-shlibdeps; the rest is loaded by name while it runs.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME palpa)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${PALPA_MAINTAINER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "visuo-haptic trainer for palpation and needle procedures")
set(CPACK_PACKAGE_DESCRIPTION "A needle is led into a virtual patient who lies on a table in a
camera's picture; a haptic loop computes a thousand times a second what
the hand would feel. After each trial a report says what happened, what
it cost, and why, in clinical words. Lumps are searched in soft tissue,
things compared between two fingers. Without a camera or a haptic device
everything runs on a simulated bench.
.
Not a medical device: it has not been validated on people.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "xdg-utils")   # opens the console in the browser
# The broker of a room; who is on the network
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "www-browser, mosquitto, avahi-daemon")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/cmake/package/postinst ${PROJECT_SOURCE_DIR}/cmake/package/postrm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
include(CPack)
