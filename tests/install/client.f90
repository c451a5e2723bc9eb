! A program of somebody else's: makes a mesh, simplifies it, reads it back.
program client
  use tetstream
  implicit none

  call run

contains

  subroutine run
    type(tetstream_reader) :: reader, again
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_stream_info) :: info
    integer(1), allocatable, target :: bytes(:)

    call reader%generate("fluid", 2000_tetstream_index)
    call writer%create_memory("vtu")
    call simplifier%create(writer)
    call simplifier%run(reader)
    call writer%get_memory(bytes)
    call again%open_memory(bytes, "vtu")
    call again%get_info(info)
    print "(3a, i0, a)", "tetstream ", tetstream_version_text(), ": ", info%cell_count, " cells"
    if (info%cell_count <= 0 .or. tetstream_library_version() /= TETSTREAM_VERSION_NUMBER) error stop 1
  end subroutine
end program
