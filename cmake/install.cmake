# What "cmake --install" puts where. Prefix /usr leads to /etc, as GNUInstallDirs has it; --prefix and DESTDIR work too.
set(PLCGW_UNIT_DIR lib/systemd/system CACHE STRING "Folder of the systemd unit, relative to the prefix or absolute")
set(PLCGW_SYSUSERS_DIR lib/sysusers.d CACHE STRING "Folder of the sysusers.d file, relative to the prefix or absolute")

install(TARGETS plc-gateway RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES systemd/plc-gateway.sysusers DESTINATION ${PLCGW_SYSUSERS_DIR} RENAME plc-gateway.conf)
install(FILES etc/plc-gateway.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/plc-gateway)
install(FILES docs/plc-gateway.8 DESTINATION ${CMAKE_INSTALL_MANDIR}/man8)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES etc/demo.json etc/plc-gateway.json DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples)

# The rest depends on the prefix, which "cmake --install --prefix" may change after configuration: done while installing.
install(CODE "
  set(source_dir [==[${PROJECT_SOURCE_DIR}]==])
  set(scratch_dir [==[${PROJECT_BINARY_DIR}]==])
  set(bindir [==[${CMAKE_INSTALL_BINDIR}]==])
  set(sysconfdir [==[${CMAKE_INSTALL_SYSCONFDIR}]==])
  set(unit_dir [==[${PLCGW_UNIT_DIR}]==])")
install(CODE [==[
  if(sysconfdir STREQUAL "etc" AND CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(sysconfdir /etc)
  endif()
  foreach(dir bindir sysconfdir unit_dir)
    if(NOT IS_ABSOLUTE "${${dir}}")
      set(${dir} "${CMAKE_INSTALL_PREFIX}/${${dir}}")
    endif()
  endforeach()

  set(PLC_GATEWAY_BINDIR "${bindir}")
  set(PLC_GATEWAY_SYSCONFDIR "${sysconfdir}")
  configure_file("${source_dir}/systemd/plc-gateway.service.in" "${scratch_dir}/plc-gateway.service" @ONLY)
  file(INSTALL "${scratch_dir}/plc-gateway.service" DESTINATION "${unit_dir}")

  # Whoever runs the gateway owns its configuration: only a missing one is installed.
  set(config "$ENV{DESTDIR}${sysconfdir}/plc-gateway/plc-gateway.json")
  if(EXISTS "${config}")
    message(STATUS "Kept: ${config}")
  else()
    file(INSTALL "${source_dir}/etc/plc-gateway.json" DESTINATION "${sysconfdir}/plc-gateway")
  endif()
]==])
