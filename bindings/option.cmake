# binding_option(NAME WHAT MISSING): the option TETSTREAM_NAME, which builds WHAT: on where nothing
# is in the list MISSING, the pieces that were not found and the packages that bring them; off below
# another project.
function(binding_option name what missing)
  set(default ${PROJECT_IS_TOP_LEVEL})
  if(missing)
    set(default OFF)
    list(JOIN missing ", " missing)
  endif()
  option(TETSTREAM_${name} "Build ${what}" ${default})
  if(TETSTREAM_${name} AND missing)
    message(FATAL_ERROR "TETSTREAM_${name} needs what is missing: ${missing}")
  elseif(missing AND PROJECT_IS_TOP_LEVEL)
    message(STATUS "tetstream: ${what}: not built; missing: ${missing}")
  endif()
endfunction()
