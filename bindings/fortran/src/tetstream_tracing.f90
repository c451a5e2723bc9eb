! Where the vertices went: maps and logs, taken by types of the caller's.
module tetstream_tracing
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_failures, only: sentence_length
  use tetstream_streams
  implicit none
  private
  public :: map_callbacks_of, log_callbacks_of

  ! Rows of a map. Points and cells are numbered from 1.
  type, public :: tetstream_map_rows
    integer(c_int64_t), allocatable :: vertices(:)     ! points of the input
    integer(c_int64_t), allocatable :: cells(:)        ! the cell of the output that each lies in
    real(c_double), allocatable :: weights(:, :)       ! (4, n) of the cell's corners; their sum is 1
  end type

  ! Rows of a log: `removed` was merged into `kept`, which has the position and the values since then.
  type, public :: tetstream_log_rows
    integer(c_int64_t), allocatable :: kept(:), removed(:)   ! points of the input, from 1
    real(c_double), allocatable :: positions(:, :)           ! (3, n)
    real(c_double), allocatable :: values(:, :)              ! (components of all float fields, n)
    real(c_double), allocatable :: errors(:)
  end type

  type, abstract, public :: tetstream_map_sink
  contains
    procedure(tetstream_take_map), deferred :: put
    procedure :: finish => map_finish        ! called once when all rows have come, never after a failure
  end type

  type, abstract, public :: tetstream_log_sink
  contains
    procedure(tetstream_take_log), deferred :: put
    procedure :: finish => log_finish        ! as that of a map
  end type

  abstract interface
    subroutine tetstream_take_map(this, rows, stat, errmsg)
      import :: tetstream_map_sink, tetstream_map_rows
      class(tetstream_map_sink), intent(inout) :: this
      type(tetstream_map_rows), intent(inout) :: rows
      integer, intent(inout) :: stat
      character(*), intent(inout) :: errmsg
    end subroutine
    subroutine tetstream_take_log(this, rows, stat, errmsg)
      import :: tetstream_log_sink, tetstream_log_rows
      class(tetstream_log_sink), intent(inout) :: this
      type(tetstream_log_rows), intent(inout) :: rows
      integer, intent(inout) :: stat
      character(*), intent(inout) :: errmsg
    end subroutine
  end interface

  ! What the callbacks of C see.
  type, public :: tracing_room
    class(tetstream_map_sink), pointer :: map => null()
    class(tetstream_log_sink), pointer :: log => null()
    integer(c_int64_t) :: values = 0  ! components of all float fields
    character(sentence_length) :: cause = ""  ! what the caller's procedure told
  end type

contains

  subroutine map_finish(this, stat, errmsg)
    class(tetstream_map_sink), intent(inout) :: this
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (unused => this, stays => stat, stays_too => errmsg)
    end associate
  end subroutine

  subroutine log_finish(this, stat, errmsg)
    class(tetstream_log_sink), intent(inout) :: this
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (unused => this, stays => stat, stays_too => errmsg)
    end associate
  end subroutine

  function map_callbacks_of(room) result(callbacks)
    type(tracing_room), intent(in), target :: room
    type(c_map_callbacks) :: callbacks

    callbacks%struct_size = c_sizeof(callbacks)
    callbacks%user = c_loc(room)
    callbacks%put = c_funloc(put_map)
    callbacks%finish = c_funloc(finish_map)
  end function

  function log_callbacks_of(room) result(callbacks)
    type(tracing_room), intent(in), target :: room
    type(c_log_callbacks) :: callbacks

    callbacks%struct_size = c_sizeof(callbacks)
    callbacks%user = c_loc(room)
    callbacks%open = c_funloc(open_log)
    callbacks%put = c_funloc(put_log)
    callbacks%finish = c_funloc(finish_log)
  end function

  ! ------------------------------------------------------------------------- what the library calls

  function put_map(user, rows) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_map_rows), intent(in) :: rows
    integer(c_int32_t) :: stopped
    type(tracing_room), pointer :: room
    type(tetstream_map_rows) :: copy
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    copy%vertices = ids(rows%vertices, rows%count)
    copy%cells = ids(rows%cells, rows%count)
    copy%weights = reals(rows%weights, 4_c_int64_t, rows%count)
    call room%map%put(copy, stat, room%cause)
    stopped = stat
  end function

  function finish_map(user) bind(c) result(stopped)
    type(c_ptr), value :: user
    integer(c_int32_t) :: stopped
    type(tracing_room), pointer :: room
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    call room%map%finish(stat, room%cause)
    stopped = stat
  end function

  function open_log(user, info) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_stream_info), intent(in) :: info
    integer(c_int32_t) :: stopped
    type(tracing_room), pointer :: room
    type(tetstream_stream_info) :: copy

    call c_f_pointer(user, room)
    call copy_info(info, copy)
    room%values = sum(copy%fields%components, copy%fields%type <= TETSTREAM_TYPE_FLOAT64)
    stopped = 0
  end function

  function put_log(user, rows) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_log_rows), intent(in) :: rows
    integer(c_int32_t) :: stopped
    type(tracing_room), pointer :: room
    type(tetstream_log_rows) :: copy
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    copy%kept = ids(rows%kept, rows%count)
    copy%removed = ids(rows%removed, rows%count)
    copy%positions = reals(rows%positions, 3_c_int64_t, rows%count)
    copy%values = reals(rows%values, room%values, rows%count)
    copy%errors = reshape(reals(rows%errors, 1_c_int64_t, rows%count), [rows%count])
    call room%log%put(copy, stat, room%cause)
    stopped = stat
  end function

  function finish_log(user) bind(c) result(stopped)
    type(c_ptr), value :: user
    integer(c_int32_t) :: stopped
    type(tracing_room), pointer :: room
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    call room%log%finish(stat, room%cause)
    stopped = stat
  end function

  ! Numbers of points or cells, from 0 in C.
  function ids(from, count) result(copy)
    type(c_ptr), intent(in) :: from
    integer(c_int64_t), intent(in) :: count
    integer(c_int64_t), allocatable :: copy(:)
    integer(c_int64_t), pointer :: values(:)

    allocate (copy(count))
    if (count == 0) return
    call c_f_pointer(from, values, [count])
    copy = values + 1
  end function

  function reals(from, components, count) result(copy)
    type(c_ptr), intent(in) :: from
    integer(c_int64_t), intent(in) :: components, count
    real(c_double), allocatable :: copy(:, :)
    real(c_double), pointer :: values(:, :)

    allocate (copy(components, count))
    if (components == 0 .or. count == 0) return
    call c_f_pointer(from, values, [components, count])
    copy = values
  end function

end module
