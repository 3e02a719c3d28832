# embed_text(TARGET FUNCTION FILES...): compiles the text files into TARGET, which gets the function
# `std::string_view FUNCTION(std::string_view name)`, declared by TARGET itself: the text of the file of that
# name (without its folder), or an empty view. FUNCTION is fully qualified. Changed files are embedded anew.
set(EMBED_TEXT_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_text_script.cmake)

function(embed_text target function)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_text.cpp)
  set(files)
  foreach(file IN LISTS ARGN)
    list(APPEND files ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DFUNCTION=${function}" "-DFILES=${files}" -P ${EMBED_TEXT_SCRIPT}
    DEPENDS ${files} ${EMBED_TEXT_SCRIPT}
    COMMENT "Embedding the text files of ${target}"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
