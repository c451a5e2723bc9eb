! Writers: where a mesh goes. A sink of the caller's is a type that extends tetstream_sink.
module tetstream_writers
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_failures
  use tetstream_streams
  implicit none
  private

  ! Takes a stream. A procedure that fails sets `stat`, not to 0, and a sentence.
  type, abstract, public :: tetstream_sink
  contains
    procedure :: open => sink_open                   ! called once, first; counts are -1 if not known
    procedure(tetstream_take), deferred :: put       ! called with each batch, which is final
    procedure :: finish => sink_finish               ! called once after a complete stream, never after a failure
    procedure :: close => sink_close                 ! called once, last
  end type

  abstract interface
    subroutine tetstream_take(this, batch, stat, errmsg)
      import :: tetstream_sink, tetstream_batch
      class(tetstream_sink), intent(inout) :: this
      type(tetstream_batch), intent(inout) :: batch
      integer, intent(inout) :: stat
      character(*), intent(inout) :: errmsg
    end subroutine
  end interface

  ! What the callbacks of C see of a sink.
  type :: writer_room
    class(tetstream_sink), pointer :: sink => null()
    type(tetstream_stream_info) :: info
    type(tetstream_batch) :: batch
    character(sentence_length) :: cause = ""  ! what the caller's procedure told
  end type

  type, public :: tetstream_writer
    type(c_ptr) :: handle = c_null_ptr
    type(writer_room), pointer, private :: room => null()
  contains
    procedure :: create => writer_create
    procedure :: create_file => writer_create_file
    procedure :: create_fd => writer_create_fd
    procedure :: create_memory => writer_create_memory
    procedure :: get_memory => writer_get_memory
    procedure :: set => writer_set
    procedure :: note => writer_note
    procedure :: cause => writer_cause
    procedure :: destroy => writer_destroy
    procedure, private :: writer_copy
    generic :: assignment(=) => writer_copy
    final :: writer_final
  end type

contains

  ! --------------------------------------------------------------------------- the caller's sink

  ! The sink must be a target, and live and stay in its place until the writer is destroyed.
  subroutine writer_create(this, sink, stat, errmsg)
    class(tetstream_writer), intent(inout) :: this
    class(tetstream_sink), intent(inout), target :: sink
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_writer_callbacks) :: callbacks

    call prepare(this)
    this%room%sink => sink
    callbacks%struct_size = c_sizeof(callbacks)
    callbacks%user = c_loc(this%room)
    callbacks%open = c_funloc(open_sink)
    callbacks%put = c_funloc(put_into_sink)
    callbacks%finish = c_funloc(finish_sink)
    callbacks%close = c_funloc(close_sink)
    call told(this, c_writer_create(callbacks, this%handle), stat, errmsg)
  end subroutine

  subroutine sink_open(this, info, stat, errmsg)
    class(tetstream_sink), intent(inout) :: this
    type(tetstream_stream_info), intent(in) :: info
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (unused => this, not_looked_at => info, stays => stat, stays_too => errmsg)
    end associate
  end subroutine

  subroutine sink_finish(this, stat, errmsg)
    class(tetstream_sink), intent(inout) :: this
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    associate (unused => this, stays => stat, stays_too => errmsg)
    end associate
  end subroutine

  subroutine sink_close(this)
    class(tetstream_sink), intent(inout) :: this

    associate (unused => this)
    end associate
  end subroutine

  function open_sink(user, info) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_stream_info), intent(in) :: info
    integer(c_int32_t) :: stopped
    type(writer_room), pointer :: room
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    call copy_info(info, room%info)
    call room%sink%open(room%info, stat, room%cause)
    stopped = stat
  end function

  function put_into_sink(user, batch) bind(c) result(stopped)
    type(c_ptr), value :: user
    type(c_batch), intent(in) :: batch
    integer(c_int32_t) :: stopped
    type(writer_room), pointer :: room
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    call copy_batch(batch, room%info, room%batch)
    call room%sink%put(room%batch, stat, room%cause)
    stopped = stat
  end function

  function finish_sink(user) bind(c) result(stopped)
    type(c_ptr), value :: user
    integer(c_int32_t) :: stopped
    type(writer_room), pointer :: room
    integer :: stat

    call c_f_pointer(user, room)
    stat = 0
    call room%sink%finish(stat, room%cause)
    stopped = stat
  end function

  subroutine close_sink(user) bind(c)
    type(c_ptr), value :: user
    type(writer_room), pointer :: room

    call c_f_pointer(user, room)
    call room%sink%close()
  end subroutine

  ! What a sink told when it stopped a run, or "".
  function writer_cause(this) result(cause)
    class(tetstream_writer), intent(in) :: this
    character(sentence_length) :: cause

    cause = ""
    if (associated(this%room)) cause = this%room%cause
  end function

  ! --------------------------------------------------------------------------- files and memory

  ! A file, which takes its name when it is complete.
  subroutine writer_create_file(this, path, format, stat, errmsg)
    class(tetstream_writer), intent(inout) :: this
    character(*), intent(in) :: path
    character(*), intent(in), optional :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:, kind=c_char), allocatable :: kind

    call prepare(this)
    call terminated(format, kind)
    call told(this, c_writer_create_file(trim(path)//c_null_char, kind, this%handle), stat, errmsg)
  end subroutine

  ! A descriptor of the system, which stays the caller's to close.
  subroutine writer_create_fd(this, fd, format, stat, errmsg)
    class(tetstream_writer), intent(inout) :: this
    integer, intent(in) :: fd
    character(*), intent(in) :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call prepare(this)
    call told(this, c_writer_create_fd(fd, trim(format)//c_null_char, this%handle), stat, errmsg)
  end subroutine

  subroutine writer_create_memory(this, format, stat, errmsg)
    class(tetstream_writer), intent(inout) :: this
    character(*), intent(in) :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call prepare(this)
    call told(this, c_writer_create_memory(trim(format)//c_null_char, this%handle), stat, errmsg)
  end subroutine

  ! The bytes of the file, once the stream is finished.
  subroutine writer_get_memory(this, bytes, stat, errmsg)
    class(tetstream_writer), intent(in) :: this
    integer(c_int8_t), allocatable, intent(inout) :: bytes(:)
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_ptr) :: place
    integer(c_size_t) :: length
    integer(c_int8_t), pointer :: found(:)
    integer(c_int32_t) :: status

    place = c_null_ptr
    length = 0
    status = c_writer_get_memory(this%handle, place, length)
    if (status >= 0) then
      call c_f_pointer(place, found, [length])
      bytes = found
    end if
    call told(this, status, stat, errmsg)
  end subroutine

  ! A property of the format, before the stream begins: "compress", "order".
  subroutine writer_set(this, property, value, stat, errmsg)
    class(tetstream_writer), intent(inout) :: this
    character(*), intent(in) :: property, value
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call told(this, c_writer_set(this%handle, trim(property)//c_null_char, trim(value)//c_null_char), stat, errmsg)
  end subroutine

  ! What the format could not hold: sentence `index`, from 1; "" after the last one.
  function writer_note(this, index) result(note)
    class(tetstream_writer), intent(in) :: this
    integer, intent(in) :: index
    character(:), allocatable :: note

    note = text_of(c_writer_note(this%handle, index - 1))
  end function

  subroutine told(this, status, stat, errmsg)
    class(tetstream_writer), intent(in) :: this
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call settle(status, c_writer_message(this%handle), stat, errmsg)
  end subroutine

  subroutine prepare(this)
    class(tetstream_writer), intent(inout) :: this

    call this%destroy()
    allocate (this%room)
  end subroutine

  subroutine writer_destroy(this)
    class(tetstream_writer), intent(inout) :: this

    call c_writer_destroy(this%handle)
    this%handle = c_null_ptr
    if (associated(this%room)) deallocate (this%room)
  end subroutine

  impure elemental subroutine writer_final(this)
    type(tetstream_writer), intent(inout) :: this

    call this%destroy()
  end subroutine

  subroutine writer_copy(this, other)
    class(tetstream_writer), intent(inout) :: this
    class(tetstream_writer), intent(in) :: other

    if (c_associated(this%handle) .or. c_associated(other%handle)) call refuse_copy("tetstream_writer")
  end subroutine

end module
