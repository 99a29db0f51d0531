! The same in Fortran: msdd.h by iso_c_binding, as far as it is used. Floating-point traps (-ffpe-trap) have to be off.
module msdd
  use, intrinsic :: iso_c_binding
  implicit none

  type, bind(c) :: msdd_column ! msdd_input and msdd_output
    type(c_ptr) :: values = c_null_ptr
    integer(c_size_t) :: stride = 1
  end type

  type, bind(c) :: msdd_grains
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: conductivity = 0, young_modulus = 0, radius = 0
    real(c_double) :: poisson_ratio = 0, roughness = 0, hardness = 0
    type(c_ptr) :: gas = c_null_ptr
    real(c_double) :: gas_pressure = 0, accommodation = 0, emissivity = 0, size_spread = 0
  end type

  type, bind(c) :: msdd_start
    integer(c_size_t) :: struct_size = 0, cells = 0, components = 3
    type(msdd_column) :: porosity, fabric_index, fabric_xy, solid_fraction
    type(c_ptr) :: stress = c_null_ptr, conductivity = c_null_ptr, fabric = c_null_ptr
    type(msdd_column) :: coordination, mobilised
  end type

  type, bind(c) :: msdd_step
    integer(c_size_t) :: struct_size = 0, cells = 0, components = 3
    type(c_ptr) :: state = c_null_ptr
    type(msdd_column) :: thermal_strain, total_thermal_strain
    type(c_ptr) :: strain = c_null_ptr, rotation = c_null_ptr
    type(msdd_column) :: temperature, solid_conductivity, emissivity
    type(c_ptr) :: next_state = c_null_ptr, stress = c_null_ptr, tangent = c_null_ptr, conductivity = c_null_ptr
    type(msdd_column) :: gas_conductivity, radiation_conductivity, solid_fraction, spread
    type(c_ptr) :: distance = c_null_ptr, outside = c_null_ptr
    integer(c_size_t) :: outside_cells = 0
  end type

  interface
    function msdd_model_load(source, model) result(status) bind(c)
      import
      character(kind=c_char), intent(in) :: source(*)
      type(c_ptr), intent(out) :: model
      integer(c_int32_t) :: status
    end function
    function msdd_model_state_size(model) result(columns) bind(c)
      import
      type(c_ptr), value :: model
      integer(c_size_t) :: columns
    end function
    function msdd_model_initial_state(model, material, start, state) result(status) bind(c)
      import
      type(c_ptr), value :: model
      type(msdd_grains), intent(in) :: material
      type(msdd_start), intent(in) :: start
      type(msdd_column), intent(in) :: state(*)
      integer(c_int32_t) :: status
    end function
    function msdd_model_advance(model, material, step) result(status) bind(c)
      import
      type(c_ptr), value :: model
      type(msdd_grains), intent(in) :: material
      type(msdd_step), intent(inout) :: step
      integer(c_int32_t) :: status
    end function
    subroutine msdd_model_free(model) bind(c)
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
  type(msdd_column), allocatable, target :: state(:)
  type(msdd_column), target :: conductivity(3), stress(3)
  type(c_ptr) :: model
  type(msdd_grains) :: material
  type(msdd_start) :: start
  type(msdd_step) :: step
  character(1024) :: source
  integer :: k

  source = 'builtin'
  if (command_argument_count() > 0) call get_command_argument(1, source)
  call check(msdd_model_load(trim(source)//c_null_char, model))
  allocate (values(cells, msdd_model_state_size(model)))
  state = [(msdd_column(c_loc(values(1, k)), 1), k = 1, size(values, 2))]

  material%struct_size = c_sizeof(material)
  material%conductivity = 100d0
  material%young_modulus = 1d7
  material%radius = 5d-3
  start%struct_size = c_sizeof(start)
  start%cells = cells
  start%porosity%values = c_loc(porosity)
  start%fabric_index%values = c_loc(fabric_index)
  call check(msdd_model_initial_state(model, material, start, state))

  conductivity(1:2)%values = [c_loc(kxx), c_loc(kyy)]
  stress(1:2)%values = [c_loc(sxx), c_loc(syy)]
  step%struct_size = c_sizeof(step)
  step%cells = cells
  step%state = c_loc(state)
  step%next_state = c_loc(state)
  step%thermal_strain%values = c_loc(strain)
  step%total_thermal_strain%values = c_loc(strain)
  step%conductivity = c_loc(conductivity)
  step%stress = c_loc(stress)
  call check(msdd_model_advance(model, material, step))
  print '(a, f7.5, a, f0.3, 1x, f0.3, a, f0.1, a)', 'porosity ', values(1, 1), ', K ', kxx(1), kyy(1), &
    ' W/(m K), pressure ', (sxx(1) + syy(1))/2, ' Pa'
  call msdd_model_free(model)
end program
