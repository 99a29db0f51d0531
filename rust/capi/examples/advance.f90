! The same in Fortran: msdd.h by iso_c_binding, as far as it is used. Floating-point traps (-ffpe-trap) have to be off.
module msdd
  use, intrinsic :: iso_c_binding
  implicit none

  type, bind(c) :: msdd_material
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: thermal_conductivity = 0, young_modulus = 0, mean_radius = 0
  end type

  type, bind(c) :: msdd_initial
    integer(c_size_t) :: struct_size = 0, cells = 0
    type(c_ptr) :: porosity = c_null_ptr, fabric_index = c_null_ptr, fabric_xy = c_null_ptr
    type(c_ptr) :: stress_xx = c_null_ptr, stress_yy = c_null_ptr, stress_xy = c_null_ptr
    type(c_ptr) :: conductivity_xx = c_null_ptr, conductivity_yy = c_null_ptr, conductivity_xy = c_null_ptr
  end type

  type, bind(c) :: msdd_batch
    integer(c_size_t) :: struct_size = 0, cells = 0
    type(c_ptr) :: state = c_null_ptr, thermal_strain = c_null_ptr, total_thermal_strain = c_null_ptr
    type(c_ptr) :: strain_xx = c_null_ptr, strain_yy = c_null_ptr, strain_xy = c_null_ptr, rotation = c_null_ptr
    type(c_ptr) :: next_state = c_null_ptr
    type(c_ptr) :: conductivity_xx = c_null_ptr, conductivity_yy = c_null_ptr, conductivity_xy = c_null_ptr
    type(c_ptr) :: stress_xx = c_null_ptr, stress_yy = c_null_ptr, stress_xy = c_null_ptr
    type(c_ptr) :: tangent = c_null_ptr
    type(c_ptr) :: clamped = c_null_ptr, outside = c_null_ptr, spread = c_null_ptr
    integer(c_size_t) :: clamped_cells = 0
  end type

  interface
    function msdd_surrogate_load(source, model) result(status) bind(c)
      import
      character(kind=c_char), intent(in) :: source(*)
      type(c_ptr), intent(out) :: model
      integer(c_int32_t) :: status
    end function
    function msdd_surrogate_state_size(model) result(columns) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_size_t) :: columns
    end function
    function msdd_surrogate_initial_state(model, material, initial, state) result(status) bind(c)
      import
      type(c_ptr), value :: model
      type(msdd_material), intent(in) :: material
      type(msdd_initial), intent(in) :: initial
      type(c_ptr), intent(in) :: state(*)
      integer(c_int32_t) :: status
    end function
    function msdd_surrogate_advance(model, material, batch) result(status) bind(c)
      import
      type(c_ptr), value :: model
      type(msdd_material), intent(in) :: material
      type(msdd_batch), intent(inout) :: batch
      integer(c_int32_t) :: status
    end function
    subroutine msdd_surrogate_free(model) bind(c)
      import
      type(c_ptr), value :: model
    end subroutine
    function msdd_last_error() result(text) bind(c)
      import
      type(c_ptr) :: text
    end function
    function strlen(text) result(length) bind(c)
      import
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function
  end interface

contains

  subroutine check(status)
    integer(c_int32_t), intent(in) :: status
    character(kind=c_char), pointer :: text(:)
    if (status == 0) return
    call c_f_pointer(msdd_last_error(), text, [strlen(msdd_last_error())])
    print '(*(a))', 'advance: ', text
    stop 1
  end subroutine
end module

program advance
  use msdd
  implicit none
  integer, parameter :: cells = 1
  real(c_double), target :: porosity(cells) = 0.125d0, fabric_index(cells) = 0.05d0, strain(cells) = 0.01d0
  real(c_double), target :: kxx(cells), kyy(cells), sxx(cells), syy(cells)
  real(c_double), allocatable, target :: values(:, :)
  type(c_ptr), allocatable, target :: state(:)
  type(c_ptr) :: model
  type(msdd_material) :: material
  type(msdd_initial) :: initial
  type(msdd_batch) :: batch
  character(1024) :: source
  integer :: k

  source = 'builtin'
  if (command_argument_count() > 0) call get_command_argument(1, source)
  call check(msdd_surrogate_load(trim(source)//c_null_char, model))
  allocate (values(cells, msdd_surrogate_state_size(model)))
  state = [(c_loc(values(1, k)), k = 1, size(values, 2))]

  material = msdd_material(c_sizeof(material), 100d0, 1d7, 5d-3)
  initial%struct_size = c_sizeof(initial)
  initial%cells = cells
  initial%porosity = c_loc(porosity)
  initial%fabric_index = c_loc(fabric_index)
  call check(msdd_surrogate_initial_state(model, material, initial, state))

  batch%struct_size = c_sizeof(batch)
  batch%cells = cells
  batch%state = c_loc(state)
  batch%next_state = c_loc(state)
  batch%thermal_strain = c_loc(strain)
  batch%total_thermal_strain = c_loc(strain)
  batch%conductivity_xx = c_loc(kxx)
  batch%conductivity_yy = c_loc(kyy)
  batch%stress_xx = c_loc(sxx)
  batch%stress_yy = c_loc(syy)
  call check(msdd_surrogate_advance(model, material, batch))
  print '(a, f7.5, a, f0.3, 1x, f0.3, a, f0.1, a)', 'porosity ', values(1, 1), ', K ', kxx(1), kyy(1), &
    ' W/(m K), pressure ', (sxx(1) + syy(1))/2, ' Pa'
  call msdd_surrogate_free(model)
end program
