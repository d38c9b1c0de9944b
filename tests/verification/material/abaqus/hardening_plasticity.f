C     Copyright 2026 The periporo authors
C     SPDX-License-Identifier: BSD-3-Clause
C
C     Von Mises plasticity with linear isotropic hardening, backward
C     Euler, in fixed-form Fortran as most UMATs are written.
C     Properties: K, G, yield stress, hardening modulus. State
C     variables: equivalent plastic strain, number of plastic steps.
C     A negative yield stress is an error.
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
C
      INCLUDE 'ABA_PARAM.INC'
C
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),
     1 DDSDDE(NTENS,NTENS),DDSDDT(NTENS),DRPLDE(NTENS),
     2 STRAN(NTENS),DSTRAN(NTENS),TIME(2),PREDEF(1),DPRED(1),
     3 PROPS(NPROPS),COORDS(3),DROT(3,3),DFGRD0(3,3),DFGRD1(3,3),
     4 JSTEP(4)
      DIMENSION INTV(1),REALV(1)
      CHARACTER*8 CHARV(1)
      PARAMETER (ZERO=0.D0,ONE=1.D0,TWO=2.D0,THREE=3.D0)
C
      BULK=PROPS(1)
      G=PROPS(2)
      IF (PROPS(3).LT.ZERO) THEN
        INTV(1)=3
        REALV(1)=PROPS(3)
        CHARV(1)=CMNAME(1:8)
        CALL STDB_ABQERR(-3,'Property %I of %S is %R',
     1   INTV,REALV,CHARV)
      END IF
C
C     Elastic trial stress; DSTRAN has engineering shear
      VOLUME=DSTRAN(1)+DSTRAN(2)+DSTRAN(3)
      DO K1=1,NDI
        STRESS(K1)=STRESS(K1)+TWO*G*DSTRAN(K1)
     1   +(BULK-TWO/THREE*G)*VOLUME
      END DO
      DO K1=NDI+1,NTENS
        STRESS(K1)=STRESS(K1)+G*DSTRAN(K1)
      END DO
C
C     Radial return
      CALL SINV(STRESS,SMEAN,SMISES,NDI,NSHR)
      EXCESS=SMISES-(PROPS(3)+PROPS(4)*STATEV(1))
      IF (EXCESS.GT.ZERO) THEN
        DEQPL=EXCESS/(THREE*G+PROPS(4))
        FACTOR=ONE-THREE*G*DEQPL/SMISES
        DO K1=1,NDI
          STRESS(K1)=SMEAN+FACTOR*(STRESS(K1)-SMEAN)
        END DO
        DO K1=NDI+1,NTENS
          STRESS(K1)=FACTOR*STRESS(K1)
        END DO
        STATEV(1)=STATEV(1)+DEQPL
        STATEV(2)=STATEV(2)+ONE
      END IF
      RETURN
      END
