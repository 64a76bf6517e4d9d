! Two oscillators of examples/02 in Fortran: Newmark's average acceleration, each step solved by Newton with both slopes of
! the law.
!   two_oscillators [STEPS]     prints the peak displacements [m], the peak force [N] and the number of impacts
program two_oscillators
  use, intrinsic :: iso_fortran_env, only: error_unit, real64
  use pounding
  implicit none

  real(real64), parameter :: pi = acos(-1.0_real64), gap = 0.02_real64, duration = 3, closes(2) = [1, -1]
  real(real64), parameter :: mass(2) = [1e5_real64, 1.5e5_real64], frequency(2) = 2*pi/[0.8_real64, 0.4_real64]
  real(real64), parameter :: stiffness(2) = mass*frequency**2, damping(2) = 2*0.05_real64*mass*frequency
  real(real64) :: h, u(2) = 0, v(2) = 0, a(2) = 0, peak(2) = 0, peak_force = 0
  integer :: steps, n, impacts = 0
  logical :: touched
  type(c_ptr) :: law
  type(pnd_contact) :: contact
  type(pnd_response) :: pressed

  steps = steps_asked(30000)
  h = duration/steps
  call stop_at_error(pnd_create('jankowski', 'exact', [pnd_value('stiffness', 2.75e9_real64), &
                                pnd_value('restitution', 0.65_real64), pnd_value('reduced_mass', 6e4_real64)], law))
  do n = 1, steps
    call advance(-mass*3*sin(2*pi*n*h/0.6_real64))
    ! The step is accepted: an impact begins, continues or ends.
    touched = contact%touching > 0
    call stop_at_error(pnd_accept(law, dot_product(closes, u) - gap, dot_product(closes, v), contact))
    if (contact%touching > 0 .and. .not. touched) impacts = impacts + 1
    peak = max(peak, abs(u))
    peak_force = max(peak_force, pressed%force)
  end do
  call pnd_destroy(law)
  print '(2f12.9, f13.3, i3)', peak, peak_force, impacts

contains

  ! One step under this load [N] at its end.
  subroutine advance(load)
    real(real64), intent(in) :: load(2)
    real(real64) :: u0(2), v0(2), a0(2), residual(2), change(2), matrix(2, 2), slope
    integer :: i

    u0 = u; v0 = v; a0 = a
    u = u0 + h*v0 + h*h/2*a0
    do i = 1, 50
      a = 4*(u - u0 - h*v0)/h**2 - a0
      v = v0 + h/2*(a0 + a)
      call stop_at_error(pnd_respond(law, contact, dot_product(closes, u) - gap, dot_product(closes, v), pressed))
      residual = load - mass*a - damping*v - stiffness*u - closes*pressed%force
      slope = pressed%by_penetration + 2/h*pressed%by_rate
      matrix(:, 1) = slope*closes*closes(1)
      matrix(:, 2) = slope*closes*closes(2)
      matrix(1, 1) = matrix(1, 1) + 4/h**2*mass(1) + 2/h*damping(1) + stiffness(1)
      matrix(2, 2) = matrix(2, 2) + 4/h**2*mass(2) + 2/h*damping(2) + stiffness(2)
      change = [matrix(2, 2)*residual(1) - matrix(1, 2)*residual(2), matrix(1, 1)*residual(2) - matrix(2, 1)*residual(1)] &
               /(matrix(1, 1)*matrix(2, 2) - matrix(1, 2)*matrix(2, 1))
      u = u + change
      if (maxval(abs(change)) < 1e-15_real64) return
    end do
    error stop 'the step does not converge'
  end subroutine

  subroutine stop_at_error(status)
    integer(c_int), intent(in) :: status
    if (status == PND_OK) return
    write (error_unit, '(a)') pnd_error_text()
    error stop 2
  end subroutine

  integer function steps_asked(otherwise) result(steps)
    integer, intent(in) :: otherwise
    character(20) :: word
    integer :: problem
    steps = otherwise
    if (command_argument_count() == 0) return
    call get_command_argument(1, word)
    read (word, *, iostat=problem) steps
    if (problem /= 0 .or. steps < 1) error stop 'STEPS must be a positive number'
  end function

end program
