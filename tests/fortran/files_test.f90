! Files, memory, layouts, inspections, diagrams, comparisons, each in the folder where the test runs.
module files_cases
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_ptr
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32, real64
  use boxes
  use checks
  use tetstream
  implicit none

  integer :: calls  ! of a procedure that is told how far opening is

  interface
    type(c_ptr) function fopen(path, mode) bind(c)
      import
      character(kind=c_char), intent(in) :: path(*), mode(*)
    end function
    integer(c_int) function fileno(file) bind(c)
      import
      type(c_ptr), value :: file
    end function
    integer(c_int) function fclose(file) bind(c)
      import
      type(c_ptr), value :: file
    end function
    integer(c_int) function creat(path, mode) bind(c)
      import
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), value :: mode
    end function
  end interface

contains

  ! A mesh with a field and regions, in a file.
  subroutine make_file(path)
    character(*), intent(in) :: path
    type(tetstream_mesh) :: mesh

    call make_boxes(6, mesh%points, mesh%cells)
    allocate (mesh%fields(1), mesh%cell_data(1))
    mesh%fields(1)%name = "wave"
    call mesh%fields(1)%set(wave(mesh%points))
    mesh%cell_data(1)%name = "part"
    call mesh%cell_data(1)%set(merge(1, 2, mesh%points(1, mesh%cells(1, :)) < 0.5))
    call tetstream_write(path, mesh)
  end subroutine

  subroutine files_are_written_and_read
    type(tetstream_mesh) :: mesh
    integer(int32), allocatable :: parts(:)
    real(real64), allocatable :: values(:)
    character(100) :: path

    path = "box.vtu"
    call make_file(path)
    call tetstream_read(path, mesh)
    call check_equal(size(mesh%points, 2), 343, "all points came back")
    call check_equal(size(mesh%cells, 2), 1296, "all cells")
    call check(abs(volume(mesh%points, mesh%cells) - 1) < 1e-12, "the cube")
    call mesh%fields(mesh%field("wave"))%get(values)
    call check(maxval(abs(values - wave(mesh%points))) == 0, "the field, to the bit")
    call mesh%cell_data(mesh%cell_array("part"))%get(parts)
    call check_equal(count(parts == 1), 648, "and the parts")
    call check(.not. allocated(mesh%faces) .and. .not. allocated(mesh%locked), "what is not there is not allocated")
  end subroutine

  subroutine a_file_goes_into_a_file
    type(tetstream_options) :: options
    type(tetstream_report) :: report
    type(tetstream_mesh) :: mesh
    integer :: stat
    character(300) :: errmsg
    logical :: exists

    call options%set("cells", 200)
    call tetstream_simplify_file("box.vtu", "small.tets", options, report=report, stat=stat)
    call check_equal(stat, TETSTREAM_OK, "it is done")
    call check(report%cells_out <= 200 .and. report%reached == "cells", "200 cells are left")
    call tetstream_read("small.tets", mesh)
    call check_equal(size(mesh%cells, 2), report%cells_out, "and in the file")

    call tetstream_simplify_file("none.vtu", "none.tets", stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_IO, "a file that is not there")
    call check_says(errmsg, "none.vtu", "is named")
    inquire (file="none.tets", exist=exists)
    call check(.not. exists, "and nothing is written")
    call tetstream_simplify_file("box.vtu", "out.xyz", stat=stat, errmsg=errmsg)
    call check(stat < 0, "a format that is none")
    call check_says(errmsg, "xyz", "is named")
    call tetstream_simplify_file("box.vtu", "out.tets", ratio=2._real64, stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "a ratio of 2")
    call options%set("regions", "nothing")
    call tetstream_simplify_file("box.vtu", "out.tets", options, stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "regions that are not there")
    inquire (file="out.tets", exist=exists)
    call check(.not. exists, "no file under the final name")
  end subroutine

  subroutine memory_is_read_and_written
    type(tetstream_reader) :: reader, again
    type(tetstream_writer) :: writer
    type(tetstream_stream_info) :: info
    integer(int8), allocatable, target :: bytes(:)
    integer :: stat
    character(300) :: errmsg

    call writer%create_memory("vtu")
    call writer%set("compress", "no")
    call writer%get_memory(bytes, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "there is nothing before the stream is finished")
    call writer%set("no-such", "1", stat, errmsg)
    call check_says(errmsg, "no-such", "a property that is none")
    call reader%generate("ball", 3000_int64, seed=2_int64)
    call tetstream_convert(reader, writer)
    call writer%get_memory(bytes)
    call check(size(bytes) > 50000, "a file in memory")
    call again%open_memory(bytes, "vtu")
    call again%get_info(info)
    call check(info%cell_count > 2000 .and. size(info%fields) == 2, "which is read")
    call check_says(info%fields(1)%name//info%fields(2)%name, "velocity", "fields have names")
    call again%open_memory(bytes(:100), "vtu", stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_BAD_DATA, "but not its first 100 bytes")
    call check(len_trim(errmsg) > 10, "which is told")
    call reader%generate("cube", 10_int64, stat=stat, errmsg=errmsg)
    call check_says(errmsg, "cube", "a kind of mesh that is none")
    call again%open_fd(-1, "vtu", stat=stat, errmsg=errmsg)
    call check(stat < 0, "a descriptor that is none")
    call writer%create_fd(-1, "nothing", stat, errmsg)
    call check(stat < 0, "for a writer, too")
  end subroutine

  ! Descriptors of the system, which stay the caller's.
  subroutine descriptors_are_read_and_written
    type(tetstream_reader) :: reader
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    type(tetstream_mesh) :: mesh
    type(c_ptr) :: file
    integer :: log, size_of_map, size_of_log

    file = fopen("box.vtu"//c_null_char, "r"//c_null_char)
    call reader%open_fd(fileno(file), "vtu")
    log = creat("box.log"//c_null_char, int(o"644"))
    call writer%create_fd(creat("fd.tets"//c_null_char, int(o"644")), "tets")
    call simplifier%create(writer)
    call simplifier%set_map_fd(creat("fd.map"//c_null_char, int(o"644")), "tetmap")
    call simplifier%set_log_fd(log, "tetlog")
    call simplifier%run(reader)
    call check_equal(fclose(file), 0, "it was not closed")
    call tetstream_read("fd.tets", mesh)
    call check(size(mesh%cells, 2) <= 129 .and. size(mesh%cells, 2) > 115, "a tenth was written")
    inquire (file="fd.map", size=size_of_map)
    inquire (file="box.log", size=size_of_log)
    call check(size_of_map > 1000 .and. size_of_log > 1000, "so were map and log")
  end subroutine

  subroutine streams_are_inspected_and_ordered
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    type(tetstream_options) :: options
    type(tetstream_stream_info) :: info
    type(tetstream_front_info) :: front
    type(tetstream_layout_report) :: report
    type(tetstream_face_label_info) :: label
    integer :: stat
    character(300) :: errmsg

    call reader%open_file("box.vtu", "vtu")
    call reader%get_front(front, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "the front is not known yet")
    call tetstream_inspect(reader, info)
    call check_equal(info%vertex_count, 343, "points are counted")
    call check_equal(size(info%box_min), 4, "the box has coordinates and a field")
    call check(all(info%box_min(:3) == 0) .and. all(info%box_max(:3) == 1), "and is the cube's")
    call reader%get_front(front)
    call check(front%width > 0 .and. front%width == info%front_width, "the front is known now")
    call reader%get_face_label(1, label, stat)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "there are no labelled faces")
    call check(reader%note(100) == "", "there is no note 100")

    call options%set("order", "hilbert")
    call reader%open_file("box.vtu")
    call writer%create_file("box.tets")
    call tetstream_layout(reader, writer, options, report)
    call check_says(report%order, "hilbert", "the order that was asked for")
    call check_equal(report%cells, 1296, "of all cells")
  end subroutine

  subroutine orders_are_drawn
    type(tetstream_reader) :: reader
    type(tetstream_diagram) :: diagram
    type(tetstream_diagram_info) :: info
    type(tetstream_raster) :: raster
    integer :: stat
    character(300) :: errmsg

    call diagram%create(60, 40)
    call diagram%get_info(info, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "nothing was read yet")
    call reader%open_file("box.tets")
    call diagram%read(reader)
    call diagram%get_info(info)
    call check_equal(info%cell_count, 1296, "cells were counted")
    call check(info%widest_cell >= 1 .and. info%widest_cell <= 1296, "they are numbered from 1")
    call diagram%get_raster(raster)
    call check(all(shape(raster%coverage) == [info%columns, info%rows]), "the raster has columns and rows")
    call check(maxval(raster%widths) == info%front_width, "its widths are the front's")
    call check(minval(raster%lowest) >= 1 .and. maxval(raster%newest) == 343, "points from 1")
    call diagram%check_path("box.bmp", stat, errmsg)
    call check_equal(stat, TETSTREAM_UNSUPPORTED, "a picture of another kind")
    call check_says(errmsg, "bmp", "is named")
    call diagram%check_path("box.svg", stat, errmsg)
    if (stat == TETSTREAM_OK) then
      call diagram%write(TETSTREAM_PAGE_LAYOUT, "box.svg", "a box")
      call diagram%write(TETSTREAM_PAGE_SWEEP, "box.svg", stat=stat, errmsg=errmsg)
      call check_equal(stat, TETSTREAM_BAD_STATE, "a sweep that was not read")
    end if
    call diagram%create(0, 1, stat=stat)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "no columns")
  end subroutine

  subroutine meshes_are_compared
    type(tetstream_reader) :: original, simplified
    type(tetstream_comparison) :: comparison
    type(tetstream_comparison_info) :: info
    type(tetstream_mesh_figures) :: figures
    type(tetstream_field_comparison) :: field
    type(tetstream_region_comparison) :: region
    type(tetstream_face_label_comparison) :: label
    type(tetstream_options) :: options
    integer :: stat
    character(300) :: errmsg

    call options%set("regions", "part")
    call get_environment_variable("TETSTREAM_SLOW", status=stat)
    if (stat == 0) call options%set("boundary-samples", 20000)
    call comparison%create(options)
    call comparison%get_info(info, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_STATE, "nothing was read yet")
    call original%open_file("box.vtu")
    call simplified%open_file("small.tets")
    call comparison%read(original, simplified)
    call comparison%get_info(info)
    call check(info%topology_kept == 1 .and. info%field_count == 1 .and. info%region_count == 2, "the topology is kept")
    call comparison%get_mesh(TETSTREAM_ORIGINAL, figures)
    call check(figures%cells == 1296 .and. abs(figures%volume - 1) < 1e-12, "the original")
    call comparison%get_field(1, field)
    call check(field%name == "wave" .and. field%rms > 0 .and. field%rms_percent < 20, "the field, from 1")
    call comparison%get_region(2, region)
    call check(region%label == 2 .and. region%original_cells == 648, "the second region")
    call comparison%get_region(3, region, stat, errmsg)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "there is no third")
    call comparison%get_face_label(1, label, stat)
    call check_equal(stat, TETSTREAM_BAD_ARGUMENT, "there are no labelled faces")
    call comparison%write("cut.svg", stat=stat, errmsg=errmsg)
    call check(stat < 0, "no cut was asked for")
    call comparison%check_path("cut.bmp", stat, errmsg)
    call check_says(errmsg, "bmp", "a picture of another kind")
  end subroutine

  ! Text is read whole when it is opened.
  subroutine opening_is_told
    type(tetstream_reader) :: reader
    type(tetstream_writer) :: writer
    type(tetstream_options) :: options
    integer :: stat
    character(300) :: errmsg

    call reader%open_file("box.tets")
    call writer%create_file("told.mesh")
    call tetstream_convert(reader, writer)
    calls = 0
    call reader%open_file("told.mesh", progress=count_calls)
    call check(calls > 0, "opening is told")
    calls = -1000
    call options%set("step", "5")
    call reader%open_result("told.mesh", options=options, progress=count_calls, stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_CANCELLED, "and can be ended, of a result, too")
    call reader%open_file("told.mesh", options=options, stat=stat)
    call check_equal(stat, TETSTREAM_UNSUPPORTED, "that has no step 5, as nobody is told any more")
  end subroutine

  subroutine count_calls(progress, cancel)
    type(tetstream_progress), intent(in) :: progress
    logical, intent(inout) :: cancel

    call check(progress%phase == "open" .and. progress%fraction <= 1, "the phase")
    cancel = calls < 0
    calls = calls + 1
  end subroutine

  ! The map and the log of a run, as files.
  subroutine traces_are_files
    type(tetstream_reader) :: reader
    type(tetstream_writer), target :: writer
    type(tetstream_simplifier) :: simplifier
    integer :: stat, size_of_map, size_of_log
    character(300) :: errmsg

    call reader%open_file("box.vtu")
    call writer%create_memory("tets")
    call simplifier%create(writer)
    call simplifier%set_map_file("box.bad", stat=stat, errmsg=errmsg)
    call check_equal(stat, TETSTREAM_UNSUPPORTED, "no format of a map")
    call simplifier%set_map_file("box.map", "csv")
    call simplifier%set_log_file("box.tetlog")
    call simplifier%run(reader)
    inquire (file="box.map", size=size_of_map)
    inquire (file="box.tetlog", size=size_of_log)
    call check(size_of_map > 343*10 .and. size_of_log > 1000, "both files are there")
    call simplifier%set_log_fd(1, "csv", stat)
    call check_equal(stat, TETSTREAM_BAD_STATE, "it is late for a log")
    call simplifier%set_map_fd(1, "csv", stat)
    call check_equal(stat, TETSTREAM_BAD_STATE, "and for a map")
  end subroutine

end module

program files_test
  use files_cases
  implicit none

  call files_are_written_and_read
  call a_file_goes_into_a_file
  call memory_is_read_and_written
  call descriptors_are_read_and_written
  call streams_are_inspected_and_ordered
  call orders_are_drawn
  call meshes_are_compared
  call opening_is_told
  call traces_are_files
  call check_end
end program
