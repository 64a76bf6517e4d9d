! Calls the user element as Abaqus/Standard would, in Hilber-Hughes-Taylor steps of two oscillators of examples/02.
!   user_element [STEPS [ALPHA]]     prints the peak displacements [m], the peak force [N] and the number of impacts
program driver
  implicit none
  real(8), parameter :: pi = acos(-1d0), mass(2) = [1d5, 1.5d5], frequency(2) = 2*pi/[0.8d0, 0.4d0]
  real(8), parameter :: stiffness(2) = mass*frequency**2, damping(2) = 2*0.05d0*mass*frequency
  real(8) :: h, alpha, beta, gamma, props(4) = [0.02d0, 2.75d9, 0.65d0, 6d4]
  real(8) :: u(2) = 0, v(2) = 0, a(2) = 0, svars(9) = 0, kept(9), peak(2) = 0, peak_force = 0
  integer :: steps, n, impacts = 0

  steps = nint(number(1, 30000d0))
  alpha = number(2, 0d0)
  if (steps < 1 .or. alpha > 0 .or. alpha < -1/3d0) error stop 'STEPS must be positive, ALPHA in [-1/3, 0]'
  beta = (1 - alpha)**2/4
  gamma = 0.5d0 - alpha
  h = 3d0/steps
  do n = 1, steps
    kept = svars
    call increment(n)
    if (svars(1) > 0 .and. .not. kept(1) > 0) impacts = impacts + 1
    peak = max(peak, abs(u))
    peak_force = max(peak_force, svars(9))
  end do
  print '(2f12.9, f13.3, i3)', peak, peak_force, impacts

contains

  ! M a + (1 + alpha) (C v + K u - p) at the end - alpha times the same at the start, and the element's share.
  subroutine increment(n)
    integer, intent(in) :: n
    real(8) :: u0(2), v0(2), a0(2), du(2, 1), residual(2), change(2), rhs(2, 1), matrix(2, 2)
    integer :: i, k

    u0 = u; v0 = v; a0 = a
    u = u0 + h*v0 + h*h/2*a0
    do i = 1, 50
      a = (u - u0 - h*v0)/(beta*h*h) - (0.5d0/beta - 1)*a0
      v = v0 + h*((1 - gamma)*a0 + gamma*a)
      svars = kept
      du(:, 1) = u - u0
      call element(n, du, rhs, matrix)
      residual = rhs(:, 1) - mass*a - (1 + alpha)*held(n*h, u, v) + alpha*held((n - 1)*h, u0, v0)
      do k = 1, 2
        matrix(k, k) = matrix(k, k) + mass(k)/(beta*h*h) + (1 + alpha)*(gamma/(beta*h)*damping(k) + stiffness(k))
      end do
      change = [matrix(2, 2)*residual(1) - matrix(1, 2)*residual(2), matrix(1, 1)*residual(2) - matrix(2, 1)*residual(1)] &
               /(matrix(1, 1)*matrix(2, 2) - matrix(1, 2)*matrix(2, 1))
      if (maxval(abs(change)) < 1d-14) return
      u = u + change
    end do
    error stop 'the increment does not converge'
  end subroutine

  function held(t, u, v)
    real(8), intent(in) :: t, u(2), v(2)
    real(8) :: held(2)
    held = damping*v + stiffness*u + mass*3*sin(2*pi*t/0.6d0)
  end function

  subroutine element(n, du, rhs, matrix)
    integer, intent(in) :: n
    real(8), intent(inout) :: du(2, 1), rhs(2, 1), matrix(2, 2)
    integer :: jdltyp(1, 1) = 0, jprops(1) = 0
    real(8) :: energy(8), coords(1, 2) = 0, load(1, 1) = 0, predef(2, 1, 2) = 0, pnewdt
    pnewdt = 1
    call uel(rhs, matrix, svars, energy, 2, 1, 9, props, 4, coords, 1, 2, u, du, v, a, 1, [n*h, n*h], h, 1, n, 1, &
             [alpha, beta, gamma], 0, jdltyp, load, predef, 1, [11, 0, 1, 0, 0], 2, load, 1, pnewdt, jprops, 0, 0d0)
  end subroutine

  real(8) function number(place, otherwise)
    integer, intent(in) :: place
    real(8), intent(in) :: otherwise
    character(30) :: word
    number = otherwise
    if (command_argument_count() < place) return
    call get_command_argument(place, word)
    read (word, *) number
  end function

end program
