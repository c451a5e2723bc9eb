! Ends by itself, in the way that the first argument names.
program stops
  use tetstream
  implicit none
  character(20) :: way
  type(tetstream_reader) :: reader, other
  type(tetstream_options) :: options, more
  type(tetstream_mesh) :: mesh
  character(100) :: errmsg

  call get_command_argument(1, way)
  select case (way)
  case ("failure")
    call tetstream_read("none.vtu", mesh)
  case ("errmsg_alone")
    call options%set("ratio", 7, errmsg=errmsg)
  case ("reader_copied")
    call reader%generate("ball", 100_tetstream_index)
    other = reader
  case ("options_copied")
    call options%set("ratio", 0.5)
    more = options
  end select
  print *, "it went on"
end program
