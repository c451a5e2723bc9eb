! The simplifier: pull, from a reader, or push, by a solver that owns the loop.
module tetstream_simplifiers
  use, intrinsic :: iso_c_binding
  use tetstream_c
  use tetstream_failures
  use tetstream_figures
  use tetstream_handover
  use tetstream_listening
  use tetstream_readers
  use tetstream_settings
  use tetstream_streams
  use tetstream_tracing
  use tetstream_writers
  implicit none
  private

  ! What the library reads or calls while the simplifier lives. The causes of failures in callbacks are
  ! with reader and writer.
  type :: simplifier_room
    type(listener) :: progress
    type(tracing_room) :: traces
    type(info_room) :: description
    type(batch_room) :: events
    type(tetstream_writer), pointer :: writer => null()
  end type

  type, public :: tetstream_simplifier
    type(c_ptr) :: handle = c_null_ptr
    type(simplifier_room), pointer, private :: room => null()
  contains
    procedure :: create => simplifier_create
    procedure :: set_progress => simplifier_set_progress
    procedure :: set_map => simplifier_set_map
    procedure :: set_map_file => simplifier_set_map_file
    procedure :: set_map_fd => simplifier_set_map_fd
    procedure :: set_log => simplifier_set_log
    procedure :: set_log_file => simplifier_set_log_file
    procedure :: set_log_fd => simplifier_set_log_fd
    procedure :: run => simplifier_run
    procedure :: begin => simplifier_begin
    procedure :: push => simplifier_push
    procedure :: finish => simplifier_finish
    procedure :: get_report => simplifier_get_report
    procedure :: destroy => simplifier_destroy
    procedure, private :: simplifier_copy
    generic :: assignment(=) => simplifier_copy
    final :: simplifier_final
  end type

contains

  ! The writer must be a target, and live until the simplifier is destroyed. Without options the
  ! defaults hold.
  subroutine simplifier_create(this, writer, options, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    type(tetstream_writer), intent(inout), target :: writer
    type(tetstream_options), intent(in), optional :: options
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call this%destroy()
    allocate (this%room)
    this%room%writer => writer
    call told(this, c_simplifier_create(handle_of(options), writer%handle, this%handle), stat, errmsg)
  end subroutine

  ! A procedure that is told how far the run is.
  subroutine simplifier_set_progress(this, progress, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    procedure(tetstream_listen) :: progress
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (is_missing(this, stat, errmsg)) return
    this%room%progress%told => progress
    call told(this, c_simplifier_set_progress(this%handle, callback_of(this%room%progress), &
                                              user_of(this%room%progress)), stat, errmsg)
  end subroutine

  ! ------------------------------------------------------------------------------ maps and logs

  subroutine simplifier_set_map(this, map, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    class(tetstream_map_sink), intent(inout), target :: map
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (is_missing(this, stat, errmsg)) return
    this%room%traces%map => map
    call told(this, c_simplifier_set_map(this%handle, map_callbacks_of(this%room%traces)), stat, errmsg)
  end subroutine

  subroutine simplifier_set_map_file(this, path, format, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    character(*), intent(in) :: path
    character(*), intent(in), optional :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:, kind=c_char), allocatable :: kind

    call terminated(format, kind)
    call told(this, c_simplifier_set_map_file(this%handle, trim(path)//c_null_char, kind), stat, errmsg)
  end subroutine

  subroutine simplifier_set_map_fd(this, fd, format, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    integer, intent(in) :: fd
    character(*), intent(in) :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call told(this, c_simplifier_set_map_fd(this%handle, fd, trim(format)//c_null_char), stat, errmsg)
  end subroutine

  subroutine simplifier_set_log(this, log, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    class(tetstream_log_sink), intent(inout), target :: log
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    if (is_missing(this, stat, errmsg)) return
    this%room%traces%log => log
    call told(this, c_simplifier_set_log(this%handle, log_callbacks_of(this%room%traces)), stat, errmsg)
  end subroutine

  subroutine simplifier_set_log_file(this, path, format, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    character(*), intent(in) :: path
    character(*), intent(in), optional :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(:, kind=c_char), allocatable :: kind

    call terminated(format, kind)
    call told(this, c_simplifier_set_log_file(this%handle, trim(path)//c_null_char, kind), stat, errmsg)
  end subroutine

  subroutine simplifier_set_log_fd(this, fd, format, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    integer, intent(in) :: fd
    character(*), intent(in) :: format
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call told(this, c_simplifier_set_log_fd(this%handle, fd, trim(format)//c_null_char), stat, errmsg)
  end subroutine

  ! -------------------------------------------------------------------------------- pull and push

  ! Reads everything, writes everything. `stat` is also TETSTREAM_TARGET_MISSED, which is no failure.
  subroutine simplifier_run(this, reader, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    type(tetstream_reader), intent(inout) :: reader
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status

    status = c_simplifier_run(this%handle, reader%handle)
    call told(this, status, stat, errmsg, reader%cause())
  end subroutine

  subroutine simplifier_begin(this, info, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    type(tetstream_stream_info), intent(in) :: info
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_stream_info) :: description
    character(sentence_length) :: refusal
    integer :: status

    if (is_missing(this, stat, errmsg)) return
    this%room%description%info = info
    description%struct_size = c_sizeof(description)
    status = TETSTREAM_OK
    call this%room%description%fill(description, status, refusal)
    if (forwarded(status, refusal, stat, errmsg)) return
    call told(this, c_simplifier_begin(this%handle, description), stat, errmsg)
  end subroutine

  ! Nothing of the batch is kept.
  subroutine simplifier_push(this, batch, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    type(tetstream_batch), intent(in) :: batch
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_batch) :: events
    character(sentence_length) :: refusal
    integer :: status

    if (is_missing(this, stat, errmsg)) return
    this%room%events%batch = batch
    events%struct_size = c_sizeof(events)
    if (allocated(this%room%description%info%fields)) then
      call this%room%events%fill(this%room%description%info, events, status, refusal)
      if (forwarded(status, refusal, stat, errmsg)) return
    end if
    call told(this, c_simplifier_push(this%handle, events), stat, errmsg)
  end subroutine

  ! The stream ends: the rest is written. `stat` as of run.
  subroutine simplifier_finish(this, stat, errmsg)
    class(tetstream_simplifier), intent(inout) :: this
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg

    call told(this, c_simplifier_finish(this%handle), stat, errmsg)
  end subroutine

  subroutine simplifier_get_report(this, report, stat, errmsg)
    class(tetstream_simplifier), intent(in) :: this
    type(tetstream_report), intent(inout) :: report
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    type(c_report) :: found
    integer(c_int32_t) :: status

    found%struct_size = c_sizeof(found)
    status = c_simplifier_get_report(this%handle, found)
    if (status >= 0) call take(found, report)
    call told(this, status, stat, errmsg)
  end subroutine

  ! ------------------------------------------------------------------------------------ the rest

  ! What is told to the caller, with what a procedure of the caller's said when it stopped the run.
  subroutine told(this, status, stat, errmsg, cause)
    class(tetstream_simplifier), intent(in) :: this
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    character(*), intent(in), optional :: cause
    character(sentence_length) :: sentence

    sentence = ""
    if (present(cause)) sentence = cause
    if (associated(this%room) .and. sentence == "") then
      sentence = this%room%writer%cause()
      if (sentence == "") sentence = this%room%traces%cause
    end if
    call settle(status, c_simplifier_message(this%handle), stat, errmsg, sentence)
  end subroutine

  ! A simplifier that was never created: told as the failure that it is.
  function is_missing(this, stat, errmsg)
    class(tetstream_simplifier), intent(in) :: this
    integer, intent(out), optional :: stat
    character(*), intent(inout), optional :: errmsg
    logical :: is_missing

    is_missing = .not. associated(this%room)
    if (is_missing) then
      call fail(TETSTREAM_BAD_STATE, "the simplifier has not been created", stat, errmsg)
    else
      call finished(stat)
    end if
  end function

  subroutine simplifier_destroy(this)
    class(tetstream_simplifier), intent(inout) :: this

    call c_simplifier_destroy(this%handle)
    this%handle = c_null_ptr
    if (associated(this%room)) deallocate (this%room)
  end subroutine

  impure elemental subroutine simplifier_final(this)
    type(tetstream_simplifier), intent(inout) :: this

    call this%destroy()
  end subroutine

  subroutine simplifier_copy(this, other)
    class(tetstream_simplifier), intent(inout) :: this
    class(tetstream_simplifier), intent(in) :: other

    if (c_associated(this%handle) .or. c_associated(other%handle)) call refuse_copy("tetstream_simplifier")
  end subroutine

end module
