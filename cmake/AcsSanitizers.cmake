# ACS_SANITIZE=address,undefined or ACS_SANITIZE=thread; the two cannot be mixed.
if(ACS_SANITIZE MATCHES "address" AND ACS_SANITIZE MATCHES "thread")
  message(FATAL_ERROR "ACS_SANITIZE: address and thread cannot be combined; build them in two folders")
endif()
if(ACS_SANITIZE)
  add_compile_options(-fsanitize=${ACS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ACS_SANITIZE})
endif()
