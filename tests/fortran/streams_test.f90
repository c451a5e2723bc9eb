! Sources and sinks of the caller's, push, progress, maps and logs; and any of them may fail.
module streams_cases
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use boxes
  use checks
  use tetstream
  implicit none

  integer, parameter :: n = 10

  ! A mesh in slabs: points as cells need them, finalized by their last uses.
  type, extends(tetstream_source) :: slabs
    real(real64), allocatable :: points(:, :)
    integer(int64), allocatable :: cells(:, :)
    logical, allocatable :: last_uses(:, :)
    integer :: step = 200, at = 0, point = 0
    integer :: opened = 0, closed = 0, calls = 0
    integer :: fails_at = -1            ! the call of `next` that fails
    integer :: wrong = 0                ! what is wrong with the batches
  contains
    procedure :: open => slabs_open
    procedure :: next => slabs_next
    procedure :: close => slabs_close
  end type

  type, extends(tetstream_sink) :: basket
    type(tetstream_stream_info) :: info
    integer(int64) :: points = 0, cells = 0, highest = 0, finalized = 0
    integer :: opened = 0, calls = 0, finished = 0, closed = 0
    integer :: fails_at = -1            ! the call of `put`; 0: open; -2: finish
    real(real64) :: error = 0
  contains
    procedure :: open => basket_open
    procedure :: put => basket_put
    procedure :: finish => basket_finish
    procedure :: close => basket_close
  end type

  type, extends(tetstream_log_sink) :: journal
    integer(int64) :: rows = 0
    integer :: finished = 0, width = 0
    logical :: fails = .false., in_range = .true.
  contains
    procedure :: put => journal_put
    procedure :: finish => journal_finish
  end type

  type, extends(tetstream_map_sink) :: failing_map
  contains
    procedure :: put => failing_map_put
  end type

  integer :: told = 0
  integer :: cancel_at = -1
  character(40) :: last_phase = ""

contains

  ! ------------------------------------------------------------------------------- the source

  subroutine fill(this)
    type(slabs), intent(inout) :: this
    logical, allocatable :: seen(:)
    integer :: i, j

    call make_boxes(n, this%points, this%cells)
    allocate (seen(size(this%points, 2)), source=.false.)
    allocate (this%last_uses(4, size(this%cells, 2)))
    do i = size(this%cells, 2), 1, -1
      do j = 1, 4
        this%last_uses(j, i) = .not. seen(this%cells(j, i))
        seen(this%cells(j, i)) = .true.
      end do
    end do
  end subroutine

  subroutine slabs_open(this, info, stat, errmsg)
    class(slabs), intent(inout) :: this
    type(tetstream_stream_info), intent(inout) :: info
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    this%opened = this%opened + 1
    call info%add_field("wave")
    call info%add_field("place", 3, TETSTREAM_TYPE_FLOAT32)
    call info%add_cell_data("box", type=TETSTREAM_TYPE_INT32)
    info%cell_count = size(this%cells, 2)
    if (this%fails_at /= 0) return
    stat = 17
    errmsg = "the slabs are not there"
  end subroutine

  subroutine slabs_next(this, batch, stat, errmsg)
    class(slabs), intent(inout) :: this
    type(tetstream_batch), intent(inout) :: batch
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    this%calls = this%calls + 1
    if (this%calls == this%fails_at) then
      stat = 18
      errmsg = "the slabs fell down"
      return
    end if
    call slab(this, batch)
    select case (this%wrong)
    case (1)
      deallocate (batch%fields)
    case (2)
      call batch%fields(1)%set(real(wave(batch%points), real32))
    case (3)
      call batch%fields(1)%set([1._real64])
    case (4)
      batch%last_uses = batch%last_uses(:, :1)
    case (5)
      batch%cells = batch%cells(:3, :)
    end select
  end subroutine

  ! The next batch of the mesh; an empty one after the last.
  subroutine slab(this, batch)
    class(slabs), intent(inout) :: this
    type(tetstream_batch), intent(inout) :: batch
    integer :: first, last, top, i

    first = this%at + 1
    last = min(this%at + this%step, size(this%cells, 2))
    if (last < first) return
    top = max(this%point, int(maxval(this%cells(:, first:last))))
    batch%points = this%points(:, this%point + 1:top)
    allocate (batch%fields(2), batch%cell_data(1))
    call batch%fields(1)%set(wave(batch%points))
    call batch%fields(2)%set(real(batch%points, real32))
    batch%cells = this%cells(:, first:last)
    call batch%cell_data(1)%set([(int((i - 1)/6, int32), i=first, last)])
    batch%last_uses = this%last_uses(:, first:last)
    this%point = top
    this%at = last
  end subroutine

  subroutine slabs_close(this)
    class(slabs), intent(inout) :: this
    this%closed = this%closed + 1
  end subroutine

  ! --------------------------------------------------------------------------------- the sinks

  subroutine basket_open(this, info, stat, errmsg)
    class(basket), intent(inout) :: this
    type(tetstream_stream_info), intent(in) :: info
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    this%opened = this%opened + 1
    this%info = info
    if (this%fails_at /= 0) return
    stat = -99
    errmsg = "the basket has no handle"
  end subroutine

  subroutine basket_put(this, batch, stat, errmsg)
    class(basket), intent(inout) :: this
    type(tetstream_batch), intent(inout) :: batch
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg
    real(real64), allocatable :: values(:)

    this%calls = this%calls + 1
    if (this%calls == this%fails_at) then
      stat = 1
      errmsg = "the basket is full"
      return
    end if
    call batch%fields(1)%get(values)
    if (size(values) > 0) this%error = max(this%error, maxval(abs(values - wave(batch%points))))
    this%points = this%points + size(batch%points, 2)
    this%cells = this%cells + size(batch%cells, 2)
    if (size(batch%cells) > 0) this%highest = max(this%highest, maxval(batch%cells))
    if (allocated(batch%last_uses)) this%finalized = this%finalized + count(batch%last_uses)
    this%finalized = this%finalized + size(batch%finalized)
  end subroutine

  subroutine basket_finish(this, stat, errmsg)
    class(basket), intent(inout) :: this
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    this%finished = this%finished + 1
    if (this%fails_at /= -2) return
    stat = 2
    errmsg = "the basket has no bottom"
  end subroutine

  subroutine basket_close(this)
    class(basket), intent(inout) :: this
    this%closed = this%closed + 1
  end subroutine

  subroutine journal_put(this, rows, stat, errmsg)
    class(journal), intent(inout) :: this
    type(tetstream_log_rows), intent(inout) :: rows
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    this%rows = this%rows + size(rows%kept)
    this%width = size(rows%values, 1)
    this%in_range = this%in_range .and. minval(rows%removed) >= 1 .and. maxval(rows%kept) <= (n + 1)**3 &
      .and. size(rows%positions, 1) == 3 .and. minval(rows%errors) >= 0
    if (.not. this%fails) return
    stat = 3
    errmsg = "the journal is torn"
  end subroutine

  subroutine journal_finish(this, stat, errmsg)
    class(journal), intent(inout) :: this
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    this%finished = this%finished + 1
    if (stat /= 0) errmsg = "a status before"
  end subroutine

  subroutine failing_map_put(this, rows, stat, errmsg)
    class(failing_map), intent(inout) :: this
    type(tetstream_map_rows), intent(inout) :: rows
    integer, intent(inout) :: stat
    character(*), intent(inout) :: errmsg

    if (extends_type_of(this, this) .and. size(rows%cells) > 0) stat = 4
    errmsg = "the map is lost"
  end subroutine

  subroutine listen(progress, cancel)
    type(tetstream_progress), intent(in) :: progress
    logical, intent(inout) :: cancel

    told = told + 1
    last_phase = progress%phase
    cancel = told == cancel_at
  end subroutine

  ! ------------------------------------------------------------------------------------- cases

  subroutine a_source_goes_to_a_sink
    type(slabs), target :: source
    type(basket), target :: sink
    type(journal), target :: log
    type(tetstream_map), target :: map
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    type(tetstream_options) :: options
    type(tetstream_simplifier) :: simplifier
    type(tetstream_report) :: report

    call fill(source)
    call options%set("ratio", 0.3)
    call options%set("window", 3000)
    call options%set("regions", "none")
    allocate (map%cells((n + 1)**3), map%weights(4, (n + 1)**3))
    map%cells = 0
    call reader%create(source)
    call writer%create(sink)
    call simplifier%create(writer, options)
    call simplifier%set_progress(listen)
    call simplifier%set_log(log)
    call simplifier%set_map(map)
    call simplifier%run(reader)
    call simplifier%get_report(report)
    call check_equal(report%cells_in, 6*n**3, "all cells were read")
    call check_equal(report%cells_out, sink%cells, "all that the report tells came out")
    call check(10*sink%cells <= 18*n**3 .and. 10*sink%cells > 17*n**3, "three tenths")
    call check_equal(sink%highest, sink%points, "points of the output are numbered from 1")
    call check_equal(sink%finalized, sink%points, "and each is finalized once")
    call check(sink%error < 0.5, "the field follows")
    call check_equal(size(sink%info%fields), 2, "the sink is told of the fields")
    call check(sink%info%fields(2)%name == "place" .and. sink%info%fields(2)%components == 3, "by name")
    call check(source%opened == 1 .and. source%closed == 1 .and. source%calls > 10, "the source was asked")
    call check(sink%opened == 1 .and. sink%calls >= 1 .and. sink%finished == 1, "the sink was called")
    call check(told > 0 .and. last_phase /= "", "progress was told")
    call check(log%rows == report%collapses .and. log%finished == 1, "every collapse was logged")
    call check(log%width == 4 .and. log%in_range, "with the components of both fields, from 1")
    call check_equal(minval(map%cells), 1, "the map has a cell for every point")
    call check(maxval(map%cells) <= sink%cells, "of the output")
    call check(100*maxval(map%cells) > 99*sink%cells, "to its end, where not every cell has a point")
    call simplifier%destroy()
    call writer%destroy()
    call check_equal(sink%closed, 1, "the sink was closed once")
  end subroutine

  subroutine a_solver_pushes
    type(slabs) :: solver
    type(basket), target :: sink, pulled
    type(slabs), target :: source
    type(tetstream_batch) :: batch
    type(tetstream_stream_info) :: info
    type(tetstream_writer) :: writer, other
    type(tetstream_reader) :: reader
    type(tetstream_options) :: options
    type(tetstream_simplifier) :: simplifier
    integer :: stat
    character(200) :: errmsg

    call fill(solver)
    solver%step = 77
    call options%set("ratio", 0.3)
    call options%set("window", 3000)
    call options%set("regions", "none")
    call writer%create(sink)
    call simplifier%create(writer, options)
    call info%add_field("wave")
    call info%add_field("place", 3, TETSTREAM_TYPE_FLOAT32)
    call info%add_cell_data("box", type=TETSTREAM_TYPE_INT32)
    info%cell_count = size(solver%cells, 2)
    call simplifier%begin(info)
    do
      batch = tetstream_batch()
      call slab(solver, batch)
      if (.not. allocated(batch%cells)) exit
      call simplifier%push(batch)
    end do
    call simplifier%finish(stat)
    call check_equal(stat, TETSTREAM_OK, "the stream is complete")
    call simplifier%push(batch, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "nothing is pushed after the end")
    call check_says(errmsg, "tetstream_simplifier_push", "and the function is named")

    call fill(source)
    call reader%create(source)
    call other%create(pulled)
    call simplifier%create(other, options)
    call simplifier%run(reader)
    call check(pulled%cells == sink%cells .and. pulled%points == sink%points, "pull and push give the same")
  end subroutine

  ! One run, in which something fails; what it came to.
  subroutine run(stat, errmsg, source_at, sink_at, wrong, log_fails, map_fails, listens)
    integer, intent(out) :: stat
    character(*), intent(out) :: errmsg
    integer, intent(in), optional :: source_at, sink_at, wrong
    logical, intent(in), optional :: log_fails, map_fails, listens
    type(slabs), target :: source
    type(basket), target :: sink
    type(journal), target :: log
    type(failing_map), target :: lost
    type(tetstream_reader) :: reader
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_options) :: options

    if (present(source_at)) source%fails_at = source_at
    if (present(sink_at)) sink%fails_at = sink_at
    if (present(wrong)) source%wrong = wrong
    errmsg = ""
    call fill(source)
    call options%set("window", 3000)
    call options%set("regions", "none")
    call reader%create(source)
    call writer%create(sink)
    call simplifier%create(writer, options)
    log%fails = present(log_fails)
    if (present(log_fails)) call simplifier%set_log(log)
    if (present(map_fails)) call simplifier%set_map(lost)
    if (present(listens)) call simplifier%set_progress(listen)
    call simplifier%run(reader, stat, errmsg)
    call simplifier%destroy()
    call writer%destroy()
    call reader%destroy()
    call check(source%opened == source%closed .and. source%opened <= 1, "a source that was opened is closed once")
    call check(sink%closed <= 1 .and. sink%closed >= sink%opened, "a sink that was opened is closed once")
    if (stat < 0 .and. sink%fails_at /= -2) call check_equal(sink%finished, 0, "after a failure nothing is finished")
  end subroutine

  subroutine callbacks_may_fail
    character(200) :: errmsg
    integer :: stat, i
    character(30), parameter :: words(5) = [character(30) :: '"wave" was announced', "announced", &
                                            "there are 1", "last_uses", "the rows of cells"]

    call run(stat, errmsg, source_at=0)
    call check_equal(stat, TETSTREAM_CALLBACK, "a source that cannot be opened")
    call check_says(errmsg, "the slabs are not there", "says why")
    call check_says(errmsg, "17", "and with which status")
    call run(stat, errmsg, source_at=3)
    call check_equal(stat, TETSTREAM_CALLBACK, "a source that fails on its way")
    call check_says(errmsg, ": the slabs fell down", "says why")
    call run(stat, errmsg, sink_at=0)
    call check_says(errmsg, ": the basket has no handle", "a sink that cannot be opened")
    call run(stat, errmsg, sink_at=1)
    call check_says(errmsg, ": the basket is full", "a sink that is full")
    call run(stat, errmsg, sink_at=-2)
    call check_says(errmsg, ": the basket has no bottom", "a sink that does not finish")
    call run(stat, errmsg, log_fails=.true.)
    call check_says(errmsg, ": the journal is torn", "a log that fails")
    call run(stat, errmsg, map_fails=.true.)
    call check_says(errmsg, ": the map is lost", "a map that fails")
    told = 0
    cancel_at = 1
    call run(stat, errmsg, listens=.true.)
    call check_equal(stat, TETSTREAM_CANCELLED, "a listener ends a run")
    cancel_at = -1
    do i = 1, size(words)
      call run(stat, errmsg, wrong=i)
      call check_equal(stat, TETSTREAM_CALLBACK, "a batch that is not what was announced")
      call check_says(errmsg, trim(words(i)), "is refused by name")
    end do
    call run(stat, errmsg)
    call check_equal(stat, TETSTREAM_OK, "and nothing of it is left over")
    call check(errmsg == "", "without a word")
  end subroutine

  subroutine pushed_batches_are_checked
    type(slabs) :: solver
    type(basket), target :: sink
    type(tetstream_batch) :: batch
    type(tetstream_stream_info) :: info
    type(tetstream_writer) :: writer
    type(tetstream_simplifier) :: simplifier
    integer :: stat
    character(200) :: errmsg

    call simplifier%push(batch, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "a simplifier that was never created")
    call check_says(errmsg, "has not been created", "says so")
    call writer%create(sink)
    call simplifier%create(writer)
    call simplifier%push(batch, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "a stream begins before it is pushed")
    call info%add_field("wave", 10, stat)
    call simplifier%begin(info, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "ten components are too many")

    call fill(solver)
    call writer%create(sink)
    call simplifier%create(writer)
    info = tetstream_stream_info()
    call info%add_field("wave")
    allocate (info%box_min(3), info%box_max(3), source=0.0_real64)
    call simplifier%begin(info, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a box without its field")
    call check_says(errmsg, "box_min: there are 3, where 4 are needed", "and it says so")
    deallocate (info%box_min, info%box_max)
    call simplifier%begin(info)
    call slab(solver, batch)
    call simplifier%push(batch, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "two fields where one was announced")
    call check_says(errmsg, "fields of a batch: there are 2, where 1 are needed", "and it says so")
    batch%fields = batch%fields(:1)
    deallocate (batch%cell_data)
    call simplifier%push(batch, stat, errmsg)
    call check_equal(stat, TETSTREAM_OK, "what was refused had no effect")
    batch%cells(1, 1) = 0
    call simplifier%push(batch, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_DATA, "a point that has not come")
    call check_says(errmsg, "vertex -1", "messages about streams count from 0")
  end subroutine

end module

program streams_test
  use streams_cases
  implicit none

  call a_source_goes_to_a_sink
  call a_solver_pushes
  call callbacks_may_fail
  call pushed_batches_are_checked
  call check_end
end program
