! Pounding between two nodes as a user element of Abaqus/Standard: direct integration (HHT) of LFLAGS(1) = 11, 12.
!
! Two nodes, one degree of freedom each; the second node lies on the positive side of the first.
! PROPS(1:4)   gap [m], stiffness [N/m^1.5], restitution [-], reduced mass [kg] of the law jankowski
! SVARS(1:8)   the impact, pnd_contact; zeros at the start
! SVARS(9)     force at the end of the last increment [N], which HHT requires
subroutine uel(rhs, amatrx, svars, energy, ndofel, nrhs, nsvars, props, nprops, coords, mcrd, nnode, u, du, v, a, jtype, &
               time, dtime, kstep, kinc, jelem, params, ndload, jdltyp, adlmag, predef, npredf, lflags, mlvarx, ddlmag, &
               mdload, pnewdt, jprops, njprop, period)
  use pounding
  implicit none
  integer :: ndofel, nrhs, nsvars, nprops, mcrd, nnode, jtype, kstep, kinc, jelem, ndload, npredf, mlvarx, mdload, njprop
  integer :: jdltyp(mdload, *), lflags(*), jprops(*)
  real(8) :: rhs(mlvarx, *), amatrx(ndofel, ndofel), svars(nsvars), energy(8), props(nprops), coords(mcrd, nnode)
  real(8) :: u(ndofel), du(mlvarx, *), v(ndofel), a(ndofel), time(2), dtime, params(3), adlmag(mdload, *)
  real(8) :: predef(2, npredf, nnode), ddlmag(mdload, *), pnewdt, period
  real(8), parameter :: closes(2) = [1, -1]
  real(8) :: penetration, rate, alpha, beta, gamma, slope
  type(c_ptr) :: law
  type(pnd_contact) :: contact
  type(pnd_response) :: pressed

  if (all(lflags(1) /= [11, 12])) then
    write (*, '(a)') 'this element is for direct integration, *Dynamic'
    error stop 2
  end if
  call stop_at_error(pnd_create('jankowski', 'exact', [pnd_value('stiffness', props(2)), pnd_value('restitution', props(3)), &
                                pnd_value('reduced_mass', props(4))], law))
  contact = transfer(svars(1:PND_CONTACT_DOUBLES), contact)
  penetration = dot_product(closes, u) - props(1)
  rate = dot_product(closes, v)
  call stop_at_error(pnd_respond(law, contact, penetration, rate, pressed))

  rhs(1:ndofel, 1) = 0
  amatrx = 0
  alpha = params(1); beta = params(2); gamma = params(3)
  select case (lflags(3))
  case (1)  ! residual and its matrix: G is (1 + alpha) times that of the end less alpha times that of the start
    rhs(1:2, 1) = -closes*((1 + alpha)*pressed%force - alpha*svars(9))
    slope = (1 + alpha)*(pressed%by_penetration + gamma/(beta*dtime)*pressed%by_rate)
    amatrx = slope*spread(closes, 2, 2)*spread(closes, 1, 2)
    ! Abaqus begins every iteration with the SVARS of the start: these count once the increment is kept.
    call stop_at_error(pnd_accept(law, penetration, rate, contact))
    svars(1:PND_CONTACT_DOUBLES) = transfer(contact, svars)
    svars(9) = pressed%force
  case (2)
    amatrx = pressed%by_penetration*spread(closes, 2, 2)*spread(closes, 1, 2)
  case (3)
    amatrx = pressed%by_rate*spread(closes, 2, 2)*spread(closes, 1, 2)
  case (4)  ! no mass
  case (5, 6)
    rhs(1:2, 1) = -closes*pressed%force
  end select
  call pnd_destroy(law)

contains

  ! In Abaqus: call stdb_abqerr(-3, pnd_error_text(), ...).
  subroutine stop_at_error(status)
    integer(c_int), intent(in) :: status
    if (status == PND_OK) return
    write (*, '(a)') pnd_error_text()
    error stop 2
  end subroutine

end subroutine
